# SPDX-License-Identifier: MIT
"""The package as such: its names, its documentation, and the wheel."""

import contextlib
import importlib.util
import inspect
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
import zipfile

import tribo
from common import InFolder, root, script


class Package(InFolder):
    def test_names_are_there_and_documented(self):
        page = (root / "docs/python.md").read_text()
        for name in tribo.__all__:
            thing = getattr(tribo, name)
            self.assertTrue(inspect.getdoc(thing), name)
            self.assertIn(name, page)

    def test_examples_of_the_manual(self):
        """All examples of the page run, one after the other, with coarse models under the names that it uses."""
        page = (root / "docs/python.md").read_text()
        examples = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertGreater(len(examples), 8)
        files = pathlib.Path("input/examples")
        files.mkdir(parents=True)
        column = (root / "input/examples/granular_column.fmcmd").read_text()
        (files / "granular_column.fmcmd").write_text(column.replace("#cell=0.05", "#cell=0.1").replace("#end=1.5", "#end=0.2"))
        disks = (root / "input/examples/two_disks.fmcmd").read_text().replace("TimeStep 1,2,0.3", "TimeStep 1,0.6,0.3")
        (files / "two_disks.fmcmd").write_text(disks)
        pathlib.Path("two_disks.fmcmd").write_text(disks)
        (files / "triaxial.xml").write_text((root / "input/examples/triaxial.xml").read_text())
        pathlib.Path("model.fmcmd").write_text("#phi=30\n" + script)
        if importlib.util.find_spec("pandas") is None:
            examples = [re.sub(r".*to_pandas.*\n", "", example) for example in examples]
        variables = {}
        for k, example in enumerate(examples):
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(example, f"docs/python.md, example {k + 1}", "exec"), variables)
            for made in pathlib.Path(".").glob("model.out"):
                shutil.rmtree(made)
        self.assertEqual(variables["problems"], [])

    def test_version(self):
        project = (root / "CMakeLists.txt").read_text()
        self.assertEqual(tribo.__version__, re.search(r"VERSION ([\d.]+)", project.split("project(Tribo")[1]).group(1))

    def test_wheel(self):
        spec = importlib.util.spec_from_file_location("wheel_backend", root / "src/python/wheel_backend.py")
        backend = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(backend)
        wheel = backend.pack(pathlib.Path(tribo.__file__).parent, ".")
        self.assertRegex(wheel.name, r"^tribo-[\d.]+-cp\d+-cp\d+-linux_\w+\.whl$")
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall("site")
        code = ("import sys; sys.path.insert(0, 'site'); import tribo, importlib.metadata as m; "
                "print(tribo.__file__, m.version('tribo'), len(m.files('tribo')))")
        done = subprocess.run([sys.executable, "-E", "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        path, version, files = done.stdout.split()
        self.assertIn("site/tribo", path)
        self.assertEqual(version, tribo.__version__)
        self.assertGreater(int(files), 12)

        # On a processor that lacks something, the import says so before it loads what was compiled.
        with open("site/tribo/_needs.py", "a") as needs:
            needs.write('features = ["sse2", "avx9000"]\n')
        done = subprocess.run([sys.executable, "-E", "-c", code], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("ImportError: this package was built for a processor with avx9000, which this one lacks", done.stderr)

    def test_threads_wait_briefly(self):
        """As those of the program do; a choice of the user holds, and child processes do not inherit what nobody chose."""
        code = "import os, tribo; print(os.environ.get('GOMP_SPINCOUNT'), os.environ.get('OMP_WAIT_POLICY'))"
        shown = {**{k: v for k, v in os.environ.items() if k not in ("GOMP_SPINCOUNT", "OMP_WAIT_POLICY")},
                 "OMP_DISPLAY_ENV": "verbose"}
        for chosen, spins, kept in (({}, "3000", "None None"), ({"GOMP_SPINCOUNT": "777"}, "777", "777 None"),
                                    ({"OMP_WAIT_POLICY": "passive"}, "0", "None passive")):
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env={**shown, **chosen})
            self.assertEqual(done.stdout.strip(), kept)
            self.assertIn(f"GOMP_SPINCOUNT = '{spins}'", done.stderr)

    def test_features_of_the_processor(self):
        from tribo import _processor
        self.assertEqual(_processor.missing("model name\t: some\nflags\t\t: fpu " + " ".join(_processor.features)), [])
        self.assertEqual(_processor.missing("flags\t\t: fpu"), _processor.features)
        self.assertEqual(_processor.missing(""), [])


if __name__ == "__main__":
    unittest.main()
