"""What the tests share."""

from __future__ import annotations

import os
import signal
import subprocess
from pathlib import Path

import matplotlib
import pytest

matplotlib.use("Agg")

# A shell that starts this in the background lets it ignore Ctrl-C, and its children too.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = Path(__file__).resolve().parents[4]


@pytest.fixture(scope="session")
def binary() -> Path:
    """The command-line program of this checkout."""
    path = Path(os.environ.get("MOTIFORM_BINARY", ROOT / "target/release/motiform"))
    if not path.exists():
        subprocess.run(["cargo", "build", "--release"], cwd=ROOT, check=True)
    return path
