"""The table [profile] of a scene file: the profile of the rollers and the number of laminae."""

from collections.abc import Mapping
from typing import ClassVar, Literal

from ...bearings.profile import RollerProfile
from ...contacts.profile import CrownedProfile, LogarithmicProfile
from ..table import Problems, check, refusal_at
from ..table_of import table_of

_OF_LAW = {"drop": ("crowned", "logarithmic"), "straight_fraction": ("crowned",), "end_ratio": ("logarithmic",)}
"""Field -> shapes that have this field."""


class ProfileTable(
    table_of(*(RollerProfile, CrownedProfile, LogarithmicProfile), optional=("drop", "straight_fraction", "end_ratio"))
):
    """Shape of the roller profile and its numbers; see `contacts.profile`.

    - `shape`: shape of the roller along its length
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"shape": ("drop", "straight_fraction", "end_ratio")}
    shape: Literal["straight", "crowned", "logarithmic"] = "straight"

    @check
    def _of_the_shape(self) -> Problems:
        for name, shapes in _OF_LAW.items():
            value = getattr(self, name)
            if value is not None and self.shape not in shapes:
                wanted = " or ".join(f"'{shape}'" for shape in shapes)
                yield refusal_at(name, f"none with shape = '{self.shape}': it is about {wanted}", f"{value:g}")
        if self.shape != "straight" and self.drop is None:
            yield refusal_at(
                "drop", f"a length, the drop at the ends of shape = '{self.shape}', e.g. '8 um'", "nothing"
            )


def roller_profile(table: ProfileTable | None) -> RollerProfile | None:
    """The profile that a table describes; `None` without a table."""
    if table is None:
        return None
    numbers = table.model_dump(include={"drop", "straight_fraction", "end_ratio"}, exclude_none=True)
    shape = None
    if table.shape != "straight":
        shape = {"crowned": CrownedProfile, "logarithmic": LogarithmicProfile}[table.shape](**numbers)
    return RollerProfile(shape, table.n_laminae)
