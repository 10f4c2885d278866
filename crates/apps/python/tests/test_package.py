"""The package as a whole: stubs, types."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import motiform

ROOT = Path(__file__).resolve().parents[4]


def test_stubs_are_those_of_the_registry() -> None:
    done = subprocess.run([sys.executable, "-m", "motiform._stubs", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types_hold() -> None:
    done = subprocess.run([sys.executable, "-m", "mypy", "--no-incremental"], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_is_documented() -> None:
    assert (Path(motiform.__file__).parent / "py.typed").exists()
    for name in motiform.__all__:
        thing = getattr(motiform, name)
        assert not callable(thing) or thing.__doc__, name
        if isinstance(thing, type):
            for member, value in vars(thing).items():
                assert member.startswith("_") or not callable(value) or value.__doc__, f"{name}.{member}"


def test_methods_name_the_page_that_goes_on() -> None:
    methods = ("simulate", "classify", "motions", "lyapunov", "equilibria", "branches", "curves", "statistics", "section")
    for thing in [*(getattr(motiform.Tensor, name) for name in methods), motiform.scan]:
        assert "docs/" in (thing.__doc__ or ""), thing
