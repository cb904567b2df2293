"""Writes the documentation of the compiled package into its stubs, where editors read it."""

import ast
import inspect
import textwrap

import dashpot

WIDTH = 120


def shown(thing):
    """Returns the documentation of an object without its examples."""
    lines = (inspect.getdoc(thing) or "").splitlines()
    kept = []
    for line in lines:
        if line.startswith(">>> "):
            break
        kept.append(line)
    return "\n".join(kept).strip()


def literal(text, indent):
    """Returns a docstring as indented lines."""
    if "\n" not in text and len(indent) + len(text) + 6 <= WIDTH:
        return [f'{indent}"""{text}"""']
    paragraphs = [
        textwrap.wrap(" ".join(paragraph.split()), WIDTH - len(indent), break_on_hyphens=False, break_long_words=False)
        for paragraph in text.split("\n\n")
    ]
    if len(paragraphs[0][0]) + len(indent) + 3 > WIDTH:
        paragraphs[0] = textwrap.wrap('"""' + " ".join(paragraphs[0]), WIDTH - len(indent), break_on_hyphens=False)
    else:
        paragraphs[0][0] = '"""' + paragraphs[0][0]
    lines = []
    for paragraph in paragraphs:
        lines += [*(indent + line for line in paragraph), ""]
    return [*lines[:-1], f'{indent}"""']


def is_docstring(statement):
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def with_docs(stubs):
    """Returns the text of the stubs with the documentation of every public class and function."""
    lines = stubs.splitlines()
    edits = []

    def visit(node, thing, indent):
        text = shown(thing)
        body = [statement for statement in node.body if not is_docstring(statement)]
        first = node.body[0]
        header = lines[first.lineno - 1]
        is_short = isinstance(first, ast.Expr) and first.value.value is ...
        documented = literal(text, indent + "    ") if text else []
        if is_short:
            # `def f() -> T: ...` or a signature of several lines that ends with `: ...`.
            start = header[: first.col_offset].rstrip()
            edits.append((first.lineno, first.lineno, [start, *documented] if documented else [header]))
        else:
            old = [statement for statement in node.body if is_docstring(statement)]
            top = min([first.lineno, *(decorator.lineno for decorator in getattr(first, "decorator_list", []))])
            end = old[0].end_lineno if old else top - 1
            begin = old[0].lineno if old else top
            following = [indent + "    ..."] if not body and not documented else []
            edits.append((begin, end, documented + following))

    for node in ast.parse(stubs).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and hasattr(dashpot, node.name):
            thing = getattr(dashpot, node.name)
            visit(node, thing, "")
            for member in getattr(node, "body", []):
                if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                    visit(member, getattr(thing, member.name), "    ")
    for begin, end, text in sorted(edits, reverse=True):
        lines[begin - 1 : end] = text
    return "\n".join(lines) + "\n"
