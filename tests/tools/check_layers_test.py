# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import check_layers


class CheckLayers(ScratchCase):
    def findings(self, name, text):
        self.write(f"src/linkwright/{name}", text)
        return check_layers.check(self.root)

    def test_downward_arrows_pass(self):
        self.assertEqual(self.findings("planar/model.h", '#include "linkwright/core/field.h"\n#include <vector>\n'), [])
        self.assertEqual(self.findings("clearance/model.h", '#include "linkwright/planar/model.h"\n'), [])

    def test_upward_arrow(self):
        self.assertEqual(self.findings("core/table.h", '\n#include "linkwright/math/angles.h"\n'),
                         ["src/linkwright/core/table.h:2: core may not use math: it lies above"])

    def test_same_floor(self):
        self.assertEqual(self.findings("planar/a.cpp", '#include "linkwright/suspension/model.h"\n'),
                         ["src/linkwright/planar/a.cpp:1: planar may not use suspension: they share a layer"])

    def test_report_knows_no_optimiser(self):
        self.assertEqual(self.findings("report/a.cpp", '#include "linkwright/optimise/problem.h"\n'),
                         ["src/linkwright/report/a.cpp:1: report may not use optimise"])

    def test_only_synthesis_optimises(self):
        line = '#include "linkwright/optimise/problem.h"\n'
        for name in ("planar/balancing/search.h", "planar/path/objective.h", "suspension/direct/synthesis.cpp",
                     "planar/studies/path_read.cpp", "planar/reproductions_paths.cpp"):
            self.assertEqual(self.findings(name, line), [])
        [finding] = self.findings("planar/four_bar/four_bar.cpp", line)
        self.assertIn("four_bar.cpp:1: below the studies, only *synthesis*", finding)

    def test_only_studies_use_study(self):
        line = '#include "linkwright/study/result.h"\n'
        for name in ("planar/studies.cpp", "planar/studies/path_read.cpp", "planar/reproductions_paths.cpp"):
            self.assertEqual(self.findings(name, line), [])
        self.assertEqual(self.findings("planar/path/synthesis.cpp", line),
                         ["src/linkwright/planar/path/synthesis.cpp:1: only planar/studies/ and studies.*, reproductions* "
                          "use study"])

    def test_folders_of_a_domain(self):
        def include(name):
            return f'#include "linkwright/{name}.h"\n'
        self.assertEqual(self.findings("planar/linkage/plan.h", include("planar/link_mass")), [])
        self.assertEqual(self.findings("planar/path/fit.h", include("planar/four_bar/kernel")), [])
        self.assertEqual(self.findings("planar/studies.cpp", include("planar/studies/path")), [])
        self.assertEqual(self.findings("clearance/studies/simulation.h", include("planar/studies/linkage")), [])
        for name, used, problem in (
                ("planar/link_mass.h", "planar/linkage/plan", "planar/ may not use planar/linkage: it lies above"),
                ("planar/linkage/plan.cpp", "planar/serial_arm/serial_arm",
                 "planar/linkage may not use planar/serial_arm: they share a layer"),
                ("planar/path/fit.cpp", "planar/studies/path", "planar/path may not use planar/studies: it lies above"),
                ("planar/studies/path.h", "planar/studies",
                 "planar/studies may not use what stands above its studies: it lies above"),
                ("clearance/open_linkage.cpp", "planar/studies/linkage",
                 "only clearance/studies/ uses planar/studies/"),
                ("planar/gears/train.h", "planar/link_mass",
                 "folder 'planar/gears' has no place (tools/check_layers.py lists them)")):
            [finding] = self.findings(name, include(used))
            self.assertEqual(finding, f"src/linkwright/{name}:1: {problem}")
            (self.root / "src/linkwright" / name).unlink()

    def test_module_without_layer(self):
        [finding] = self.findings("gears/model.h", "")
        self.assertIn("module 'gears' belongs to no layer", finding)
        self.write("src/linkwright/gears/model.h")
        self.assertEqual(len(self.findings("app/run.cpp", '#include "linkwright/gears/model.h"\n')), 2)

    def test_links(self):
        self.assertEqual(self.findings("math/CMakeLists.txt", "linkwright_module(math\n  DEPENDS linkwright_study)\n"),
                         ["src/linkwright/math/CMakeLists.txt:2: math may not use study: it lies above"])

    def test_heavy_header(self):
        self.assertEqual(self.findings("study/read.cpp", "#include <toml++/toml.h>\n"), [])
        self.assertEqual(self.findings("study/read.h", "#include <toml++/toml.h>\n"),
                         ["src/linkwright/study/read.h:1: <toml++/toml.h> is heavy: include it in sources, not in headers"])

    def test_header_that_shows_a_heavy_one(self):
        self.assertEqual(self.findings("optimise/pagmo_adapters.h", "#include <pagmo/problem.hpp>\n"), [])
        self.assertEqual(self.findings("optimise/pagmo_bridge.h", "#include <pagmo/problem.hpp>\n"),
                         ["src/linkwright/optimise/pagmo_bridge.h:1: <pagmo/problem.hpp> is heavy: include it in sources, "
                          "not in headers"])
        self.write("src/linkwright/optimise/pagmo_bridge.h")
        include = '#include "linkwright/optimise/pagmo_adapters.h"\n'
        self.assertEqual(self.findings("optimise/pagmo_adapters.cpp", include), [])
        self.assertEqual(self.findings("optimise/methods.h", include),
                         ["src/linkwright/optimise/methods.h:1: <linkwright/optimise/pagmo_adapters.h> shows a heavy header: "
                          "include it in sources, not in headers"])

    def test_operating_system_in_one_place(self):
        text = "#include <unistd.h>\n\nint id() { return ::getpid(); }  // not ::getppid()\n"
        self.assertEqual(self.findings("core/platform/processes.cpp", text), [])
        self.assertEqual(self.findings("app/run.cpp", text),
                         ["src/linkwright/app/run.cpp:1: <unistd.h> belongs to the operating system: "
                          "what it is asked for goes to core/platform/",
                          "src/linkwright/app/run.cpp:3: ::getpid() is a function of the operating system: what it is asked for goes to "
                          "core/platform/"])

    def test_include_without_module(self):
        self.write("src/linkwright/core/table.h")
        self.assertEqual(self.findings("core/table.cpp", '#include "table.h"\n'),
                         ['src/linkwright/core/table.cpp:1: say "linkwright/core/table.h": every include names its module'])


if __name__ == "__main__":
    unittest.main()
