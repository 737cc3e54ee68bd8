"""One report of how fast and how exact everything is: Markdown and JSON.

    python -m pytest tests/benchmarks                      # writes benchmark_report/report.md and report.json
    python tests/benchmarks/benchmark_report.py [--out FOLDER] [--only roller,ball] [--quick]

Each section (`sections/`) runs in a process of its own, one after the other: its peak memory is that process's, and one
that fails leaves the others alone; the report then says so and the command ends with status 1.
"""

import argparse
import contextlib
import gc
import importlib.metadata
import importlib.util
import json
import os
import platform
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
SECTIONS = HERE / "sections"
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]

from section_shape import Section, Table  # noqa: E402

FIRST = ("traction", "roller", "ball", "tapered", "scaling", "dynamics", "film", "fit", "sweep", "public")
"""Order of the sections; others follow by name."""
LONGEST = 600
"""Seconds after which a section has failed."""
PACKAGES = ("jaxbearing", "jax", "jaxlib", "numpy", "scipy", "diffrax", "optimistix", "equinox")
RIVALS = ("tamaas", "ross-rotordynamics", "exudyn")


def section_names() -> list[str]:
    found = {path.stem for path in SECTIONS.glob("*.py") if path.stem != "__init__"}
    return [name for name in FIRST if name in found] + sorted(found - set(FIRST))


def load(path: Path):
    """A module from its file: the benchmarks are no package."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    return module


def environment() -> dict[str, str]:
    """Where and with what the numbers were made."""
    model = platform.processor() or platform.machine()
    with contextlib.suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model)
    commit = ""
    with contextlib.suppress(OSError):  # no git
        commit = subprocess.run(
            ["git", "describe", "--always", "--dirty"], cwd=HERE, capture_output=True, text=True, check=False
        ).stdout.strip()
    found = {
        "date": time.strftime("%Y-%m-%d"),
        "machine": f"{model}, {os.cpu_count()} cores",
        "platform": os.environ.get("JAX_PLATFORMS") or "as jax chooses",
        "floats": "64 bits",
        "commit": commit or "unknown",
        "python": platform.python_version(),
    }
    for name in (*PACKAGES, *RIVALS):
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            found[name] = importlib.metadata.version(name)
    return found


def run_here(name: str, quick: bool) -> dict:
    """A section in this process, with what it took."""
    begin = time.perf_counter()
    section = load(SECTIONS / f"{name}.py").section(quick)
    jax = sys.modules.get("jax")
    return {
        "title": section.title,
        "text": section.text,
        "tables": [table._asdict() for table in section.tables],
        "facts": section.facts,
        "seconds": time.perf_counter() - begin,
        # kilobytes on Linux, bytes on macOS
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024),
        "devices": "" if jax is None else f"{len(jax.devices())} x {jax.devices()[0].device_kind}",
    }


def error_line(said: str, nothing: str) -> str:
    """The line that names the exception, or the last one of what a process said."""
    lines = said.strip().splitlines() or [nothing]
    return next(
        (line for line in reversed(lines) if re.match(r"[\w.]+(Error|Exception|Exit|Interrupt): ", line)), lines[-1]
    )


def run_apart(name: str, quick: bool, folder: Path) -> dict:
    """A section in a process of its own; where it fails, the end of what it said."""
    answer = folder / f"{name}.json"
    answer.unlink(missing_ok=True)
    command = [sys.executable, str(HERE / "benchmark_report.py"), "--section", name, "--answer", str(answer)]
    # without what tests/conftest.py sets for quick compilation
    settings = {key: value for key, value in os.environ.items() if key != "JAX_DISABLE_MOST_OPTIMIZATIONS"}
    if settings.get("JAX_PLATFORMS", "cpu") == "cpu":
        settings["XLA_FLAGS"] = f"--xla_force_host_platform_device_count={os.cpu_count()}"
    try:
        done = subprocess.run(
            [*command, *(["--quick"] if quick else [])],
            env=settings,
            capture_output=True,
            text=True,
            timeout=LONGEST,
            check=False,
        )
        said = done.stderr
    except subprocess.TimeoutExpired:
        return {"failed": f"took more than {LONGEST} s"}
    if not answer.exists():
        return {"failed": error_line(said, "it said nothing")}
    try:
        return json.loads(answer.read_text())
    except ValueError:  # stopped while it wrote
        return {"failed": error_line(said, "half an answer")}
    finally:
        answer.unlink()


def _cell(value) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.3g}"
    return str(value).replace("|", "\\|")


def table_text(table: dict) -> list[str]:
    head = "| " + " | ".join(map(_cell, table["columns"])) + " |"
    rule = "|" + "---|" * len(table["columns"])
    rows = ["| " + " | ".join(map(_cell, row)) + " |" for row in table["rows"]]
    return [table["caption"], "", head, rule, *rows, ""]


def markdown(report: dict) -> str:
    """The whole report."""
    lines = ["# Speed against error", ""]
    lines += [f"- {name}: {value}" for name, value in report["environment"].items()]
    whole = sum(found.get("seconds", 0.0) for found in report["sections"].values())
    lines += ["", f"Times are of warm runs, the best of several, where nothing else is said; {whole:.0f} s in all.", ""]
    for name, found in report["sections"].items():
        if "failed" in found:
            lines += [f"## {name}: FAILED", "", found["failed"], ""]
            continue
        lines += [f"## {found['title']}", "", found["text"], ""]
        for table in found["tables"]:
            lines += table_text(table)
        lines += [f"{found['seconds']:.0f} s, at most {found['memory'] / 2**30:.2f} GiB, {found['devices']}.", ""]
    return "\n".join(lines)


def write_report(names: list[str], out: Path, quick: bool, run=run_apart) -> dict:
    """Run the sections and write both files; they are whole after every section."""
    out.mkdir(parents=True, exist_ok=True)
    report = {"environment": environment(), "sections": {}}
    for name in names:
        report["sections"][name] = run(name, quick, out)
        (out / "report.json").write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
        (out / "report.md").write_text(markdown(report), encoding="utf-8")
        found = report["sections"][name]
        state = f"FAILED: {found['failed']}" if "failed" in found else f"{found['seconds']:.0f} s"
        print(f"{name}: {state}", file=sys.stderr, flush=True)
    return report


def facts_of(report: dict) -> dict[str, float]:
    """Single numbers of all sections."""
    return {
        f"{name}: {fact}": value
        for name, found in report["sections"].items()
        for fact, value in found.get("facts", {}).items()
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("benchmark_report"))
    parser.add_argument("--only", help="names of sections, with commas")
    parser.add_argument("--quick", action="store_true", help="smaller everything: to see that it runs")
    parser.add_argument("--section", help=argparse.SUPPRESS)
    parser.add_argument("--answer", type=Path, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.section:
        sys.argv = sys.argv[:1]
        from jaxbearing.numerics.garbage import RARELY

        gc.set_threshold(*RARELY)  # as `jaxbearing` does where it traces
        arguments.answer.write_text(json.dumps(run_here(arguments.section, arguments.quick)), encoding="utf-8")
        return 0
    names = arguments.only.split(",") if arguments.only else section_names()
    report = write_report(names, arguments.out, arguments.quick)
    print(f"written: {arguments.out / 'report.md'}, {arguments.out / 'report.json'}")
    return 1 if any("failed" in found for found in report["sections"].values()) else 0


if __name__ == "__main__":
    sys.exit(main())

__all__ = ["Section", "Table", "facts_of", "load", "markdown", "section_names", "write_report"]
