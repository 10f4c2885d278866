"""motiform's lanes against their rivals: one command, one run, one table. See README.md.

    python3 bench/ensemble/bench.py [--quick] [--only adaptive,amplitudes,lyapunov,noisy,short,threads,precision]
"""

import argparse
import json
import logging
import os
import re
import tempfile
import time
from pathlib import Path

import environment

GROUPS = "adaptive amplitudes lyapunov noisy short threads precision".split()


def arguments():
    parser = argparse.ArgumentParser(description="motiform's lanes against their rivals")
    parser.add_argument("--quick", action="store_true", help="a quarter of the work, three repeats: under 3 minutes")
    parser.add_argument("--only", default=",".join(GROUPS), help="some of " + ",".join(GROUPS))
    found = parser.parse_args()
    found.only = found.only.split(",")
    unknown = set(found.only) - set(GROUPS)
    if unknown:
        parser.error(f"no group {', '.join(sorted(unknown))}; there are {', '.join(GROUPS)}")
    return found


def stem(description):
    """Path of the results, without an ending: when, and on what."""
    model = re.sub(r"[^A-Za-z0-9.]+", "-", re.sub(r"\(\w+\)|CPU|Processor|@", "", description["processor"])).strip("-")
    environment.RESULTS.mkdir(exist_ok=True)
    return environment.RESULTS / f"{time.strftime('%Y-%m-%d-%H%M')}-{model}"


def elsewhere():
    """Goes to an empty folder: setuptools, by which a rival compiles, would read the pyproject.toml of this repository."""
    given = os.environ.get("MOTIFORM_BENCH")
    if given and Path(given).exists():
        os.environ["MOTIFORM_BENCH"] = str(Path(given).resolve())
    os.chdir(tempfile.mkdtemp())


def main():
    chosen = arguments()
    environment.enter_venv()
    elsewhere()
    logging.disable(logging.INFO)  # some rivals log every step of their compilers
    environment.one_core()

    import amplitudes
    import exponents
    import noisy
    import precision
    import table
    import tasks

    begin = time.perf_counter()
    scale, repeats = (0.25, 3) if chosen.quick else (1.0, 11)
    record = {"description": environment.description(), "quick": chosen.quick, "groups": {}}
    d = record["description"]
    name = stem(d)
    text = []

    def say(block):
        """Shown, and kept at once: what is measured is not lost if a rival takes the whole process down."""
        text.append(block)
        print(block, flush=True)
        record["load_at_end"], record["seconds"] = environment.load(), time.perf_counter() - begin
        name.with_suffix(name.suffix + ".json").write_text(json.dumps(record, indent=1))
        name.with_suffix(name.suffix + ".txt").write_text("\n".join(text) + "\n")

    def group(key, title, unit_rows):
        rows, notes = unit_rows
        record["groups"][key] = {"title": title, "rows": [vars(row) for row in rows]}
        say(table.group(title, rows, notes))

    flags = " ".join(name for name, has in d["flags"].items() if has)
    say(f"{d['processor']}, {d['cores']} cores, {flags}; {d['kernel']}; load {d['load_at_start']}")
    say(", ".join(f"{name} {version}" for name, version in d["versions"].items()))
    if "adaptive" in chosen.only:
        for rtol in (1e-9, 1e-12):
            rows = tasks.orbits("adaptive", tasks.T, rtol, scale, repeats, per_orbit=False)
            group(f"adaptive {rtol:g}", f"Adaptive, tolerance {rtol:g}, one core", rows)
    if "amplitudes" in chosen.only:
        title = "The tensor model as text, tolerance 1e-9, one core"
        group("amplitudes", title, amplitudes.rows(scale, repeats))
    if "lyapunov" in chosen.only:
        group("lyapunov", "Six Lyapunov exponents, one core", tasks.lyapunov(scale, repeats, chosen.quick))
        block, record["exponents"] = exponents.verify(scale, chosen.quick)
        say(block)
    if "noisy" in chosen.only:
        group("noisy", "Orbits under noise", noisy.rows(scale, repeats))
    if "short" in chosen.only:
        rows = tasks.orbits("short", tasks.T_SHORT, 1e-9, scale, repeats, per_orbit=True)
        group("short", "Many short orbits, t = 10, tolerance 1e-9, one core", rows)
    if "threads" in chosen.only:
        rows, pairs = tasks.threads(scale, repeats)
        title = "Threads, all cores"
        record["groups"]["threads"] = {"title": title, "rows": [vars(row) for row in rows]}
        say(table.speed_up(title, pairs))
    if "precision" in chosen.only:
        points, failed = precision.measure(scale, 2 if chosen.quick else 7, chosen.quick)
        record["precision"] = {"points": points, "failed": failed}
        say(precision.table(points, failed))
        try:
            precision.draw(points, environment.RESULTS / "work_precision")
        except ImportError as error:
            say(f"no figure: {error}")
    say(f"\n{time.perf_counter() - begin:.0f} s; load at the end {environment.load()}")
    print(f"written: results/{name.name}.json, .txt")


if __name__ == "__main__":
    main()
