"""What a first answer costs: programs, and whole processes."""

from benchmark_report import HERE, load
from section_shape import Section, Table


def section(quick=False):
    script = load(HERE / "first_answer.py")
    programs = {name: script.program(name) for name in (script.SCENES[-1:] if quick else script.SCENES)}
    asked = {name: script.cold_and_warm(arguments) for name, arguments in script.processes(quick).items()}
    return Section(
        "The first answer",
        "Size of the program of one solve, processor time to trace and to compile it with all optimisations and "
        "quickly, and how the two differ; then whole processes, with an empty cache folder and once more.",
        (
            Table(
                "Programs:",
                ("scene", "lines", "trace, CPU s", "compile", "quickly", "run, ms", "quick run, ms", "difference"),
                tuple(
                    (name, one.lines, *one[1:4], 1e3 * one.run_optimised, 1e3 * one.run_quick, one.difference)
                    for name, one in programs.items()
                ),
            ),
            Table(
                "Processes:",
                ("what", "cold, CPU s", "warm, CPU s", "cold, s", "warm, s"),
                tuple(
                    (name, cold.processor, warm.processor, cold.wall, warm.wall) for name, (cold, warm) in asked.items()
                ),
            ),
        ),
        {
            "quick and optimised differ by": max(one.difference for one in programs.values()),
            "processes that failed": float(sum(not (cold.well and warm.well) for cold, warm in asked.values())),
        },
    )
