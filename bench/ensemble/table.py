"""The table: plain text, aligned."""

import statistics


def number(x):
    """Four digits, thousands as powers of ten."""
    return f"{x:.3g}" if 0.01 <= abs(x) < 1000 else f"{x:.3e}"


def leader(rows):
    """The quickest verified row of motiform."""
    mine = [r for r in rows if r.name.startswith("motiform") and not r.failed]
    return max(mine, key=lambda r: r.best, default=None)


def quotients(mine, row):
    """motiform / this program: of the best runs, and the median of the quotients of neighbouring runs."""
    return mine.best / row.best, statistics.median(a / b for a, b in zip(mine.rates, row.rates))


def ratio(row, mine):
    if mine is None or row.failed or row.unit != mine.unit:
        return f"{'-':>8} {'-':>8}"
    return " ".join(f"{x:8.2f}" if x < 1000 else f"{x:8.0f}" for x in quotients(mine, row))


def group(title, rows, notes=()):
    mine = leader(rows)
    lines = ["", title, "=" * len(title)]
    lines.append(f"{'':40} {'best':>10} {'median':>10} {'unit':14} {'error':>8}      motiform/this")
    lines.append(f"{'':40} {'':>10} {'':>10} {'':14} {'':>8}      best     med.")
    for row in rows:
        if row.failed:
            lines.append(f"{row.name:40} - {row.failed}")
            continue
        lines.append(
            f"{row.name:40} {number(row.best):>10} {number(row.median):>10} {row.unit:14} {row.error:8.1e}"
            f"  {ratio(row, mine)}"
        )
    if mine:
        lines.append(f"  motiform = {mine.name}")
    return "\n".join(lines + [f"  {note}" for note in notes])


def speed_up(title, pairs):
    """Rows (name, one thread, more threads)."""
    lines = ["", title, "=" * len(title), f"{'':40} {'1 thread':>10} {'2 threads':>10}  speed-up (best, median)"]
    for name, one, more in pairs:
        if one.failed or more.failed:
            lines.append(f"{name:40} - {one.failed or more.failed}")
            continue
        best, median = quotients(more, one)
        lines.append(
            f"{name:40} {number(one.best):>10} {number(more.best):>10}  {best:5.2f} {median:5.2f}   {one.unit}"
        )
    return "\n".join(lines)
