"""Measurements of one rig: operating points and the values measured there, in SI."""

import dataclasses
from collections.abc import Mapping

import numpy as np

FLOOR = 0.2
"""Floor of an assumed error: that of a value of this part of the largest value of the measured quantity."""


@dataclasses.dataclass(frozen=True, eq=False)
class Data:
    """Measurements of one rig, SI; every array has one entry per operating point.

    **Arguments:**
    - `conditions`: values by dotted path of a scene's field; fields that do not vary have the scene's value.
    - `measured`: values by path of a result, such as "power_loss.total"; NaN where it was not measured.
    - `deviations`: standard deviations by path of a result; results without an entry have assumed ones.
    - `held_back`: mask of points that are not fitted but only predicted.
    - `origin`: name of the file.

    **Raises:** `ValueError` for arrays of different length, nothing measured, deviations that are not positive.
    """

    conditions: Mapping[str, np.ndarray]
    measured: Mapping[str, np.ndarray]
    deviations: Mapping[str, np.ndarray] = dataclasses.field(default_factory=dict)
    held_back: np.ndarray | None = None
    origin: str = "data"

    def __post_init__(self):
        if not self.measured:
            raise ValueError("measured: found nothing; expected results with their values, such as 'power_loss.total'")
        arrays = {**self.conditions, **{f"measured {name}": value for name, value in self.measured.items()}}
        arrays |= {f"deviation of {name}": value for name, value in self.deviations.items()}
        for name, value in arrays.items():
            if np.ndim(value) != 1 or len(value) != self.points:
                raise ValueError(f"{name}: found the shape {np.shape(value)}, expected {self.points} numbers")
        for name in self.deviations:
            if name not in self.measured:
                raise ValueError(f"deviations: found '{name}', which is not measured")
            used = np.isfinite(self.measured[name])
            if not np.all(np.asarray(self.deviations[name])[used] > 0.0):
                raise ValueError(f"deviations: found one of {name} that is not positive; expected numbers > 0")
        if not any(np.any(np.isfinite(value)) for value in self.measured.values()):
            raise ValueError("measured: found no finite value; expected one or more")

    @property
    def points(self) -> int:
        """Number of operating points."""
        return len(next(iter(self.measured.values())))

    @classmethod
    def of(cls, source: object) -> "Data":
        """The given data, or the data of a mapping with the same names, whose numbers become arrays of float64."""
        if isinstance(source, Data):
            return source
        if not isinstance(source, Mapping) or not {"measured"} <= set(source) <= {
            f.name for f in dataclasses.fields(cls)
        }:
            raise ValueError("data: expected calibration.Data, or a mapping with conditions and measured")
        arrays = lambda part: {name: np.asarray(value, dtype=float) for name, value in dict(part).items()}
        whole = {"conditions": arrays(source.get("conditions", {})), "measured": arrays(source["measured"])}
        held = source.get("held_back")
        return cls(
            **whole,
            deviations=arrays(source.get("deviations", {})),
            held_back=None if held is None else np.asarray(held, dtype=bool),
            origin=source.get("origin", "data"),
        )


@dataclasses.dataclass(frozen=True, eq=False)
class Observations:
    """All measured values of all rigs, one after the other.

    **Arguments:**
    - `value`, `deviation`: measured value, and its standard deviation, given or assumed.
    - `held_back`: mask of the values that are only predicted.
    - `rig`, `point`: number of the rig, and of the operating point in its data.
    - `name`: path of the result.
    """

    value: np.ndarray
    deviation: np.ndarray
    held_back: np.ndarray
    rig: np.ndarray
    point: np.ndarray
    name: np.ndarray

    @classmethod
    def of(cls, rigs: list[Data], relative: float) -> "Observations":
        """The measured values of these data.

        **Arguments:** `relative`: standard deviation over value that is assumed where none is given; `FLOOR` times that
        of the largest value is added as a root of the sum of squares.
        """
        columns: list[list[np.ndarray]] = [[] for _ in range(6)]
        for number, data in enumerate(rigs):
            held = np.zeros(data.points, dtype=bool) if data.held_back is None else np.asarray(data.held_back)
            for name, value in data.measured.items():
                points = np.flatnonzero(np.isfinite(value))
                size = np.abs(value[points])
                largest = np.max(size, initial=0.0)
                assumed = relative * np.hypot(size, FLOOR * largest) if largest > 0.0 else np.ones(len(points))
                stated = data.deviations.get(name)
                deviation = assumed if stated is None else np.asarray(stated)[points]
                row = (value[points], deviation, held[points], np.full(len(points), number), points)
                for column, part in zip(columns, (*row, np.full(len(points), name, dtype=object)), strict=True):
                    column.append(part)
        return cls(*(np.concatenate(column) for column in columns))

    def __len__(self) -> int:
        return len(self.value)
