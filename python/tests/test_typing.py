"""The stubs have the documentation of the package, and type checkers accept every example of the documents."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from common import DATA
from stub_docs import with_docs

STUBS = DATA.parent / "python/dashpot/__init__.pyi"


def examples(folder):
    """Writes the Python of the document and of the examples to a folder; returns the names."""
    sources = {}
    for path in ("docs/python.md", "python/README.md"):
        text = (DATA.parent / path).read_text()
        blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        sources[path.replace("/", "_").replace(".md", ".py")] = "\n".join(blocks)
    for path in (DATA.parent / "python/examples").rglob("*.py"):
        sources[path.name] = path.read_text()
    for name, text in sources.items():
        pathlib.Path(folder, name).write_text(text)
    return sorted(sources)


class Typing(unittest.TestCase):
    def check(self, *checker):
        with tempfile.TemporaryDirectory() as folder:
            names = examples(folder)
            self.assertGreater(len(names), 2)
            done = subprocess.run(
                [sys.executable, "-m", *checker, *names], cwd=folder, capture_output=True, text=True
            )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stubs_have_the_documentation_of_the_package(self):
        text = STUBS.read_text()
        expected = with_docs(text)
        if os.environ.get("DASHPOT_BLESS") == "1":
            STUBS.write_text(expected)
            return
        self.assertEqual(text.splitlines(), expected.splitlines(), "DASHPOT_BLESS=1 rewrites the stubs")

    def test_mypy_accepts_the_examples(self):
        # The package distributed has annotations for few of its functions.
        self.check("mypy", "--strict", "--untyped-calls-exclude=distributed")

    def test_pyright_accepts_the_examples(self):
        # basedpyright is pyright in one package of Python; its own stricter rules are left out.
        self.check("basedpyright", "--level", "error", "--pythonpath", sys.executable)
