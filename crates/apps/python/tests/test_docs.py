"""The Python of the documentation runs: blocks of a page one after the other, as a reader would type them."""

from __future__ import annotations

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest
from conftest import ROOT

PAGES = ("README.md", "docs/python.md", "docs/clusters.md")
NEEDS = {"docs/python.md": ("scipy",), "docs/clusters.md": ("distributed",)}


def blocks(page: Path) -> list[tuple[int, str]]:
    """Line and text of each block of Python."""
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    return [(text.count("\n", 0, match.start(1)), match.group(1)) for match in found]


@pytest.mark.parametrize("name", PAGES)
@pytest.mark.filterwarnings("ignore:::distributed", "ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning")
def test_the_python_of_a_page_runs(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in NEEDS.get(name, ()):
        pytest.importorskip(module)
    monkeypatch.chdir(tmp_path)
    found = blocks(ROOT / name)
    assert len(found) >= (1 if name == "README.md" else 3)
    names: dict[str, object] = {"__name__": "__main__"}
    for line, text in found:
        exec(compile("\n" * line + text, str(ROOT / name), "exec"), names)
    plt.close("all")
