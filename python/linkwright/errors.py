# SPDX-License-Identifier: BSD-3-Clause
"""What is raised when a study is wrong."""


class StudyError(ValueError):
    """A study cannot be read or run. Its text is what the command line says; `diagnostics` has the places."""

    def __init__(self, diagnostics):
        self.diagnostics = list(diagnostics)
        super().__init__("\n".join(map(str, self.diagnostics)))

    def __reduce__(self):
        return type(self), (self.diagnostics,)
