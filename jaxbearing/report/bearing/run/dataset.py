"""A transient run as a labelled xarray data set.

Every labelled field of the result classes becomes one variable, as in `bearing.dataset`. Results of an instant have the
leading dimension `time`; results of the rolling elements (`load_inner`) have `time` and `element`. `state_elements` and
`state_cage` are the integrated state, in SI units and in the frame of the run.
"""

import numpy as np
import xarray as xr

from ....bearings.motion.history import History
from ....numerics.status import Status
from ...history_shocks import FACES, SHOCK, peaks_by_turn, sectors, whirl_ratio
from ...labels import labelled, variable_name
from ...run_statistics import cage_stress, groove_energy, sliding_energy
from ...variables import attributes, flags, identity_text, variable, without_fill


def to_dataset(history: History) -> xr.Dataset:
    """All results of a run with `units`, `long_name` and `path` on every variable."""
    dataset = xr.Dataset(attrs=attributes(history, "Motion of a rolling bearing"))
    dataset.attrs |= {"solver": history.solver, "completed": int(history.completed)} | identity_text(history.identity)
    dataset.attrs["not_modelled"] = ", ".join(history.not_modelled)
    for path, value, metadata in labelled(history):
        short = path.removeprefix("instants.")
        dataset[variable_name(short)] = variable(value, metadata, short, () if short == path else ("time",))
    dataset["status"].attrs |= flags(dataset["status"].dtype, [status.text for status in Status])
    count = dataset.sizes["element"]
    dataset = dataset.assign(_statistics(history)).assign(_energies_and_stresses(history))
    names: dict[str, tuple[np.ndarray | list[str], str, str]] = {
        "element": (np.arange(count), "1", "number of the rolling element; azimuth says where it is")
    }
    states = {"element_state": history.instants.element_state, "cage_state": history.instants.cage_state}
    names |= {dim: (list(parts), "1", "component of the state") for dim, parts in states.items()}
    if "groove_angle" in dataset.dims:
        text = "contact angle at the middle of the interval over which the loss is added up"
        names["groove_angle"] = (history.instants.groove_angles, "rad", text)
    coordinates = {
        dim: xr.Variable((dim,), values, {"units": unit, "long_name": text})
        for dim, (values, unit, text) in names.items()
    }
    dataset = dataset.assign_coords(coordinates).set_coords([n for n in dataset if str(n).startswith("operation_")])
    return without_fill(dataset)


def _statistics(history: History) -> dict[str, xr.Variable]:
    """Shocks turn by turn and over the azimuth, and the whirl of the cage."""
    variables: dict[str, xr.Variable] = {}
    say = lambda unit, text: {"units": unit, "long_name": text, "path": "summary"}
    whirl, peaks, spread = whirl_ratio(history), peaks_by_turn(history), sectors(history)
    if whirl is not None:
        text = "mean angular speed of the cage's centre about its mean place over the mean cage speed"
        variables["whirl_ratio"] = xr.Variable((), whirl, say("1", text))
    if peaks is not None and spread is not None:
        text = "largest pocket load of each rolling element in each turn of the cage; the last turn may be a part"
        variables["turn_peak"] = xr.Variable(("face", "turn", "element"), peaks, say("N", text))
        text = f"a pocket load above this is a shock: {SHOCK}"
        variables["shock_threshold"] = xr.Variable((), spread.threshold, say("N", text))
        text = "number of shocks by azimuth"
        variables["shock_count"] = xr.Variable(("face", "sector"), spread.number, say("1", text))
        text = "mean peak of the shocks by azimuth"
        variables["shock_mean_peak"] = xr.Variable(("face", "sector"), spread.mean_peak, say("N", text))
        text = "azimuth from the load line at which the sector begins"
        variables["sector"] = xr.Variable(("sector",), spread.edges[:-1], say("rad", text))
        variables["face"] = xr.Variable(("face",), list(FACES), say("1", "wall of the pocket"))
        turns = np.arange(1, peaks.shape[1] + 1)
        variables["turn"] = xr.Variable(("turn",), turns, say("1", "turn of the cage since the start of the run"))
    return variables


def _energies_and_stresses(history: History) -> dict[str, xr.Variable]:
    """Energy dissipated by sliding at each element and over the groove angle, and stresses of the cage."""
    say = lambda unit, text: {"units": unit, "long_name": text, "path": "summary"}
    places = {"inner": "on the inner raceway", "outer": "on the outer raceway", "pocket": "in its pocket"}
    variables = {
        f"sliding_energy_{place}": xr.Variable(
            ("element",), energy, say("J", f"energy that sliding of the element {places[place]} takes over the run")
        )
        for place, energy in sliding_energy(history).items()
    }
    for side, energy in groove_energy(history).items():
        text = f"energy that sliding takes over the run in each interval of angle of the {side} groove"
        variables[f"groove_energy_{side}"] = xr.Variable(("groove_angle",), energy, say("J", text))
    stress = cage_stress(history)
    if stress is not None:
        variables["cage_hoop_stress"] = xr.Variable(
            ("time",), stress.hoop, say("Pa", "stress of the cage by its rotation")
        )
        text = "largest bending stress of the cage rails, by the pocket loads of the instant"
        variables["cage_rail_stress"] = xr.Variable(("time",), stress.rail, say("Pa", text))
        text = "bending stress of the cage bar ahead of the element, by its largest load since the instant before"
        variables["cage_bar_stress"] = xr.Variable(("time", "element"), stress.bar, say("Pa", text))
    return variables
