"""Every public name is documented with a working example and listed in `__all__`."""

import ast
import doctest
import os
import pathlib
import re
import tempfile
import tomllib
import types
import unittest

import dashpot
from common import DATA, command


def documented():
    """Yields each public object and its name."""
    yield "dashpot", dashpot
    for name in dashpot.__all__:
        thing = getattr(dashpot, name)
        yield name, thing
        if isinstance(thing, type) and not issubclass(thing, (BaseException, int)):
            for member, value in vars(thing).items():
                if not member.startswith("_"):
                    yield f"{name}.{member}", value


class Documentation(unittest.TestCase):
    def test_all_lists_every_public_name(self):
        public = {
            name for name, thing in vars(dashpot).items()
            if not name.startswith("_") and not isinstance(thing, types.ModuleType)
        }
        self.assertEqual(set(dashpot.__all__), public)
        self.assertEqual(dashpot.__all__, sorted(dashpot.__all__, key=lambda name: (name[0].islower(), name)))

    def test_the_version_is_that_of_the_command(self):
        self.assertEqual(command("-V").split()[-1], dashpot.__version__)

    def test_python_files_parse_with_the_oldest_supported_version(self):
        project = tomllib.loads((pathlib.Path(__file__).parents[1] / "pyproject.toml").read_text())["project"]
        oldest = project["requires-python"].removeprefix(">=")
        major, minor = map(int, oldest.split("."))
        files = [path for path in pathlib.Path(dashpot.__file__).parent.iterdir() if path.suffix in (".py", ".pyi")]
        self.assertIn("__init__.pyi", [path.name for path in files])
        for path in files:
            ast.parse(path.read_text(), path, feature_version=(major, minor))

    def test_everything_is_documented(self):
        missing = [name for name, thing in documented() if not getattr(thing, "__doc__", None)]
        self.assertEqual(missing, [])

    def test_examples_work(self):
        parser, runner, run = doctest.DocTestParser(), doctest.DocTestRunner(), []
        for name, thing in documented():
            test = parser.get_doctest(thing.__doc__, {}, name, None, None)
            if test.examples:
                runner.run(test)
                run.append(name)
        self.assertEqual(runner.summarize().failed, 0)
        without = [name for name in dashpot.__all__ if name not in run]
        self.assertEqual(without, [])

    def test_code_in_the_document_runs(self):
        self.run_document("docs/python.md")

    def test_code_in_the_readme_runs(self):
        self.run_document("python/README.md")

    def run_document(self, path):
        text = (DATA.parent / path).read_text()
        # Every fenced block is run; every indented line must be a shell command.
        fenced = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
        self.assertEqual({language for language, _ in fenced.findall(text)}, {"python"})
        indented = re.findall(r"^    (.*)$", fenced.sub("", text), re.MULTILINE)
        self.assertEqual([line for line in indented if not line.startswith(("cargo ", "python3 -m "))], [])
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                space = {}
                for number, (_, block) in enumerate(fenced.findall(text)):
                    exec(compile(block, f"{path}, block {number}", "exec"), space)
            finally:
                os.chdir(before)
