"""The environment of a run: virtual environment, one core, what the processor is, versions."""

import os
import platform
import subprocess
import sys
from importlib import metadata
from pathlib import Path

HERE = Path(__file__).resolve().parent
VENV, BUILD, RESULTS = HERE / ".venv", HERE / "build", HERE / "results"
PACKAGES = "numpy scipy matplotlib heyoka numba jax diffrax exponax sympy jitcode setuptools pynamicalsys".split()
THREADS = 2  # of the rows with threads
ALL_CORES = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else set()


def enter_venv():
    """Run again inside the benchmark's own virtual environment, made on the first call (or $BENCH_PYTHON's)."""
    python = Path(os.environ.get("BENCH_PYTHON") or VENV / "bin" / "python")
    if Path(sys.prefix) == python.parent.parent or os.environ.get("BENCH_INSIDE"):
        return
    if not python.exists():
        print("making the virtual environment ...", flush=True)
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    if python.parent.parent == VENV and not (VENV / "complete").exists():
        for package in PACKAGES:  # one by one: a rival that cannot be installed costs its own rows only
            done = subprocess.run([python, "-m", "pip", "install", "-q", package])
            print(f"  {package}: {'installed' if done.returncode == 0 else 'cannot be installed'}", flush=True)
        (VENV / "complete").touch()
    os.environ["BENCH_INSIDE"] = "1"
    os.execv(python, [str(python), *sys.argv])


def one_core():
    """Every program on one core, one thread; before anything numerical is imported."""
    names = "OMP_NUM_THREADS OPENBLAS_NUM_THREADS MKL_NUM_THREADS NUMBA_NUM_THREADS RAYON_NUM_THREADS".split()
    for name in names:
        os.environ[name] = "1"
    os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
    os.environ["JAX_PLATFORMS"] = "cpu"
    os.environ["JAX_ENABLE_X64"] = "1"
    pin()


def pin(cores=None):
    """Keep this thread, and the programs it starts, on the given cores; without any, on the last one."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, cores or {max(ALL_CORES)})


def first_line(*command):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        return "none"


def version(package):
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def load():
    return [round(x, 2) for x in os.getloadavg()]


def processor():
    """Model name and the flags that matter, from /proc/cpuinfo where there is one."""
    model, flags = platform.processor() or platform.machine(), set()
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            key, _, value = line.partition(":")
            if key.strip() == "model name":
                model = value.strip()
            elif key.strip() in ("flags", "Features"):
                flags = set(value.split())
    except OSError:
        pass
    return model, {name: name in flags for name in ("avx2", "avx512f", "fma")}


def description():
    """Everything about the machine that a reader of the numbers needs."""
    model, flags = processor()
    return {
        "processor": model,
        "flags": flags,
        "cores": len(ALL_CORES) or os.cpu_count(),
        "kernel": f"{platform.system()} {platform.release()}",
        "versions": {
            "python": platform.python_version(),
            "gcc": first_line("gcc", "-dumpfullversion"),
            "rustc": first_line("rustc", "--version").removeprefix("rustc "),
            "motiform": first_line("git", "-C", str(HERE), "describe", "--always", "--dirty"),
            **{package: version(package) for package in PACKAGES},
            "llvmlite": version("llvmlite"),
            "jaxlib": version("jaxlib"),
        },
        "load_at_start": load(),
    }
