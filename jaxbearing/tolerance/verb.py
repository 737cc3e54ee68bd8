"""The function `tolerances`, which computes the scatter of a scene's results from that of its fields."""

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from .._scene import AbstractScene
from ..joint import JointDistribution
from ..numerics.compiling import require_outside
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..numerics.precision import require_x64
from ..solve import require_solvable
from .delta import spreads_of
from .derivatives import Slopes, slopes_at
from .outcome import Samples, Tolerances
from .results import labels_of, names_in
from .scatter import Scatter, scatter_of, scatter_of_source

if TYPE_CHECKING:
    import xarray as xr

    from ..sweeps.plan import Plan


@rare_garbage_collection()
def tolerances(
    scene: AbstractScene | str | os.PathLike[str],
    over: Mapping[str, object] | None = None,
    *,
    results: Sequence[str] | None = None,
    samples: int = 0,
    seed: int = 0,
    out: str | os.PathLike[str] | None = None,
    options: NewtonOptions | None = None,
    chunk: int | None = None,
    devices: int | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Callable[[int], None] | None = None,
    drag_prior: bool = True,
    posterior: JointDistribution | str | os.PathLike[str] | None = None,
) -> Tolerances:
    """Scatter of the results of a scene whose fields have tolerances.

        scene = jb.load_scene("deep_groove_6205_fitted")
        found = jb.tolerances(scene, {"geometry.diametral_clearance": {"low": 5e-6, "high": 20e-6}}, samples=10_000)
        found["fit.clearance"].mean, found["fit.clearance"].deviation, found["fit.clearance"].contributions

    Mean, standard deviation and contributions follow from one solve and its exact derivatives (delta method); with
    `samples` random samples are solved too, as a sweep. All fields are independent of each other, except those of a
    posterior.

    **Arguments:**
    - `scene`: scene from `load_scene`, or built from parts; or a scene file or the name of a built-in scene, where the
      fields given as distributions scatter. Seats with a tolerance class scatter in any case if `fits.at` is "mean":
      the tolerances of shaft and bore, hole and outside diameter are six standard deviations each.
    - `over`: dotted path of a field -> `Distribution`, or a mapping with `mean` and `deviation`, or `low` and `high`,
      and `shape`, "normal" (if not given), "uniform" or "lognormal"; or `median` and `log_deviation` of a lognormal
      one, with `low` and `high` where these cut it off; SI units.
    - `results`: paths of results, or their names in data sets ("fit.clearance", "power_loss_total"); those of a
      rolling element with its number, "contact_angle_inner[0]". Not given: clearance, contact angles, displacements,
      power loss, life, as far as the scene has them.
    - `samples`: number of random samples, 0 or at least 2; `seed`: of their random numbers.
    - `out`: file of the samples, `.nc` or `.zarr`. A stopped run continues there when it is called again.
    - `options`: options of the solver.
    - `chunk`, `devices`, `workers`, `scheduler`, `overwrite`, `progress`: as those of `jaxbearing.sweep`.
    - `drag_prior`: True if the drag coefficient of a bearing, which is never well known, scatters by an assumed
      distribution (`bearings.priors`) where it has no other.
    - `posterior`: fields that scatter together, as found by a calibration: `calibration.joint_of` of it, or the
      file that `jaxbearing calibrate --out FILE.nc` writes. It prevails over distributions of the scene's file.

    **Raises:** `SolveError` where the solve at the means fails; `ValueError` where nothing scatters, for a field or a
    result that is not one number, for what is no distribution, for a file that holds no posterior; `AttributeError`
    for a field that is not there; `SceneError` for a scene file that cannot be read.
    """
    require_x64()
    joint = posterior_of(posterior)
    if isinstance(scene, AbstractScene):
        require_solvable(scene)
        instead = "it looks at the numbers; jax.grad and jax.jvp of solve can"
        require_outside("tolerances", instead, scene)
        label, scatter = type(scene).__name__, scatter_of(scene, over, drag_prior, joint)
    else:
        label, scatter = scatter_of_source(os.fspath(scene), drag_prior=drag_prior, posterior=joint)
        if over:
            alone = {path: field for path, field in scatter.fields.items() if path not in scatter.together}
            scatter = scatter_of(scatter.scene, alone | dict(over), drag_prior, scatter.joint)
    analysis = Analysis(scatter, label, NewtonOptions() if options is None else options)
    outcome = analysis.tolerances(results)
    if samples:
        plan = analysis.plan(outcome, samples, seed, chunk)
        outcome = _with_samples(analysis, outcome, plan, seed, out, devices, workers, scheduler, overwrite, progress)
    return outcome


def posterior_of(posterior: JointDistribution | str | os.PathLike[str] | None) -> JointDistribution | None:
    """The posterior, read from its file if a file is given. **Raises:** `ValueError` for another file."""
    if posterior is None or isinstance(posterior, JointDistribution):
        return posterior
    from ..report.joint_file import read_joint

    return read_joint(posterior)


@dataclass(frozen=True)
class Analysis:
    """A scene with its scatter, and the solver options of its analysis."""

    scatter: Scatter
    label: str
    options: NewtonOptions

    def tolerances(self, results: Sequence[str] | None = None) -> Tolerances:
        """Scatter by the delta method. **Raises:** `SolveError`; `ValueError` for an unknown result."""
        from ..sweeps.fields import label_of

        at_means = self._at(self.scatter.means, results)
        at_means.solution.raise_if_failed()
        known: dict[tuple[float, ...], Slopes | None] = {}

        def evaluated(numbers: Mapping[str, float]) -> Slopes | None:
            key = tuple(numbers[path] for path in self.scatter.means)
            if key not in known:
                values = {path: numbers[path] for path in self.scatter.means}
                try:
                    self.scatter.scene.replace(values)
                except ValueError:
                    known[key] = None  # a worst case that the scene refuses, such as a groove narrower than its ball
                else:
                    known[key] = self._at(values, results)
            return known[key]

        names = names_in(at_means.solution, results)
        spreads, notes = spreads_of(self.scatter, names, at_means, evaluated)
        still = [name for name, spread in spreads.items() if not spread.moves]
        if still:
            notes.append(f"these fields do not change {', '.join(still)}")
        if results is None:
            # of the usual results, keep those that these fields change
            spreads = {name: spread for name, spread in spreads.items() if spread.moves} or spreads
        return Tolerances(
            fields=self.scatter.fields,
            units={path: label_of(self.scatter.scene, path)["units"] for path in self.scatter.fields},
            origins=self.scatter.origins,
            results=spreads,
            samples=None,
            warnings=(*self.scatter.notes, *notes, *at_means.solution.warnings),
            solution=at_means.solution,
        )

    def plan(self, outcome: Tolerances, count: int, seed: int, chunk: int | None) -> "Plan":
        """The samples as a sweep. **Raises:** `ValueError` for counts that are not possible."""
        from ..sweeps.fields import label_of
        from ..sweeps.verb import make_plan
        from .monte_carlo import cases_of

        cases = cases_of(self.scatter, count, seed)
        metadata = {path: label_of(self.scatter.scene, path) for path in cases.paths}
        elements = any("[" in name for name in outcome.results)
        return make_plan(
            *(self.scatter.recipe(cases), cases, metadata, self.label),
            options=self.options,
            elements=elements,
            chunk=chunk,
        )

    def with_samples(self, outcome: Tolerances, dataset: "xr.Dataset", seed: int, file: str | None) -> Tolerances:
        """Adds the statistics of samples that a sweep has solved."""
        from .monte_carlo import failures_in, sampled

        statistics = sampled(dataset, labels_of(outcome.solution, tuple(outcome.results)))
        spreads = {name: replace(spread, sampled=statistics[name]) for name, spread in outcome.results.items()}
        failures = failures_in(dataset)
        count = int(dataset["failure"].size)
        samples = Samples(count, count - sum(failures.values()), seed, failures, file)
        return replace(outcome, results=spreads, samples=samples)

    def _at(self, numbers: Mapping[str, float], results: Sequence[str] | None) -> Slopes:
        return slopes_at(self.scatter.scene, numbers, results, self.options)


def _with_samples(
    analysis: Analysis,
    outcome: Tolerances,
    plan: "Plan",
    seed: int,
    out: str | os.PathLike[str] | None,
    devices: int | None,
    workers: int | None,
    scheduler: str | None,
    overwrite: bool,
    progress: Callable[[int], None] | None,
) -> Tolerances:
    from ..report.stores import opened
    from ..sweeps.engine import Watcher, run
    from ..sweeps.verb import runner_of

    runner = runner_of(devices, workers, scheduler)
    watcher = Watcher() if progress is None else Watcher(cases=progress)
    with tempfile.TemporaryDirectory(prefix="jaxbearing-tolerances-") as folder:
        target = Path(folder) / "samples.nc" if out is None else Path(out)
        run(plan, target, runner=runner, overwrite=overwrite, watcher=watcher)
        with opened(target) as dataset:
            return analysis.with_samples(outcome, dataset, seed, None if out is None else os.fspath(out))
