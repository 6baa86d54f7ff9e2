# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_words


class CheckWords(ScratchCase):
    def findings(self, text, name="docs/page.md"):
        self.write(name, text)
        return check_words.check(self.root)

    def test_plain_text_passes(self):
        self.assertEqual(self.findings(
            "colour #112233, build/tmp/x, https://example.org/work/page, ~/work/x, method, the work/rest ratio\n"), [])

    # The words are put together here, so that the check of this repository does not find this file.
    def test_machine_paths(self):
        for folder in ("wo" "rk", "tm" "p", "ho" "me", "ro" "ot"):
            [finding] = self.findings(f"first\nsee /{folder}/data.json\n")
            self.assertEqual(finding, f"docs/page.md:2: '/{folder}/d': path of a machine")

    def test_tracker_numbers(self):
        for text in ("see iss" "ue #12", "Fix" "es #3", "GH" "-77"):
            [finding] = self.findings(text)
            self.assertIn("number of a tracker", finding)

    def test_unfinished_business(self):
        for word in ("TO" "DO", "FIX" "ME", "XX" "X"):
            [finding] = self.findings(f"// {word}: later", "src/linkwright/core/a.cpp")
            self.assertIn("src/linkwright/core/a.cpp:1", finding)

    def test_words_given_up(self):
        for text in ("the error is told", "A loose crank pin", "links that bend", "the wheel guide", "computed anew",
                     "the name stands twice", "'x' is no number", "the way of the pin", "in the place of a number",
                     "the run goes on", "what is of use", "how far the points are off"):
            for name, line in (("docs/page.md", text), ("examples/studies/a.toml", f"# {text}"),
                               ("src/linkwright/core/a.cpp", f'warn("{text}");')):
                [finding] = self.findings(f"first\n{line}\n", name)
                self.assertIn(f"{name}:2: ", finding)
                (self.root / name).unlink()
        for text in ('#include "a/regulation.h"', "// told", "told();", 'R"(loose pin)"', 'warn("there is no joint");',
                     'warn("S stands for a ball joint, which stands still");', 'warn("it is no longer than that");',
                     'visit("stand_in", "the other way round");'):
            self.assertEqual(self.findings(text, "src/linkwright/core/a.cpp"), [])

    def fragments(self, text, name="src/linkwright/core/a.cpp"):
        self.write(name, text)
        return [(count, [(number, said) for _, number, said in found])
                for count, found in check_words.fragments(self.root).values()]

    def test_comments_that_begin_as_fragments(self):
        self.assertEqual(self.fragments("/// What it is.\nint a;  ///< of the pin\nint b;  // the length of\n"
                                        "// Of those\n// that bend.\n\n// When it stops, the run ends.\n"),
                         [(5, [(1, "What it is."), (2, "of the pin"), (4, "Of those")])])
        self.assertEqual(self.fragments('f("// of");\nR"(// of)";\n}  // namespace of\n// NOLINT of\n'), [])
        self.assertEqual(self.fragments("const a = /\\/\\/ of/;\n`// of`;\nconst b = { /* of the chart */ };\n", "web/src/a.ts"),
                         [(1, [(3, "of the chart")])])
        (self.root / "web/src/a.ts").unlink()
        self.assertEqual(self.fragments('a = "# of"  # how long\n', "tools/a.py"), [(1, [(1, "how long")])])

    def test_a_module_has_few_fragments(self):
        sentences = "// The force.\n\n" * 19
        self.assertEqual(self.findings(sentences + "// of the pin\n", "src/linkwright/core/a.cpp"), [])
        [first, second] = self.findings(sentences + "// of the pin\n\n// whether it moves\n", "src/linkwright/core/a.cpp")
        self.assertEqual(first, "src/linkwright/core/a.cpp:39: 'of the pin': a fragment; write a sentence or name the thing")
        self.assertIn("a.cpp:41: 'whether it moves'", second)

    def test_names_given_up(self):
        self.write("src/linkwright/core/a.h", 'int tell_all, wayOf, subway, tellAll;  // told\nauto x = "kept";\n')
        self.assertEqual(check_words.names_given_up(self.root), {"tell": 2, "way": 1})

    def test_binary_and_generated_files_are_left_alone(self):
        self.assertEqual(self.findings("TO" "DO", "package-lock.json"), [])
        (self.root / "picture.png").write_bytes(b"\xff\xfe TO" b"DO")
        self.assertEqual(check_words.check(self.root), [])


if __name__ == "__main__":
    unittest.main()
