"""Table and file of a long run."""

import json
from pathlib import Path

import numpy as np
from campaign.judge import Verdict

COLUMNS = (
    "structure",
    "cases",
    "converged",
    "no equilibrium, certified",
    "refused",
    "failed",
    "steps: median, most",
    "residual",
    "closure",
    "other balances",
    "gradient",
    "alone",
    "breaches",
    "s",
)


def row(v: Verdict) -> tuple[str, ...]:
    numbers = (v.cases, v.converged, v.no_equilibrium, v.refused, v.failed)
    steps = f"{v.median_steps:g}, {v.most_steps}"
    errors = (v.worst_residual, v.worst_closure, v.worst_balance, v.worst_gradient)
    return (
        v.structure,
        *(str(number) for number in numbers),
        steps,
        *("-" if error is None else f"{error:.0e}" for error in errors),
        str(v.alone),
        str(len(v.breaches)),
        f"{v.seconds:.0f}",
    )


def table(verdicts: list[Verdict]) -> str:
    """Markdown."""
    lines = [" | ".join(COLUMNS), " | ".join("---" for _ in COLUMNS)]
    return "\n".join(f"| {line} |" for line in [*lines, *(" | ".join(row(v)) for v in verdicts)])


def totals(verdicts: list[Verdict]) -> str:
    cases, converged = sum(v.cases for v in verdicts), sum(v.converged for v in verdicts)
    failed, none = sum(v.failed for v in verdicts), sum(v.no_equilibrium for v in verdicts)
    share = converged / max(converged + failed, 1)
    return (
        f"{cases} scenes in {sum(v.seconds for v in verdicts):.0f} s: {converged} converged, {none} certified to have "
        f"no equilibrium, {failed} not converged: {100 * share:.2f} % of those with an equilibrium"
    )


def write(verdicts: list[Verdict], file: Path) -> None:
    """Every breach with all its numbers."""
    plain = lambda value: value.tolist() if isinstance(value, np.ndarray | np.generic) else value
    cases = [
        {**breach._asdict(), "numbers": {name: plain(value) for name, value in breach.numbers.items()}}
        for verdict in verdicts
        for breach in verdict.breaches
    ]
    rows = [{k: v for k, v in verdict._asdict().items() if k != "breaches"} for verdict in verdicts]
    file.write_text(json.dumps({"structures": rows, "breaches": cases}, indent=1))
