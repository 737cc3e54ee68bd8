"""The commented scene file of a standard bearing."""

import math
from collections.abc import Iterator, Mapping

from ..scenes.quantity_texts import text_in
from ..scenes.units import ANGLE, FORCE, LENGTH
from .designation import Designation
from .dimensions import clearance_limits
from .duty import Duty, Line, oil_lines, operation_lines, quoted
from .geometry import Estimate, Geometry
from .tapered import TaperedShape, tapered_shape

KINDS = {"cylindrical": "cylindrical_roller_bearing", "tapered": "tapered_roller_bearing"}
UNKNOWN_CLEARANCE = {"C2": 0.08, "CN": 0.25, "C3": 0.45, "C4": 0.7}
"""Diametral clearance over bore, micrometres per millimetre, for bores beyond the table: usual values, uncertain by
half of them."""
GROOVES = {"inner": (0.52, 0.51, 0.53), "outer": (0.53, 0.515, 0.54)}
"""Usual conformities, each with the lower and upper end of the makers' range, where the ratings do not determine
them."""


LAWS_HINT = (
    '# laws = "best"  # adds {best}. It needs [oil], such as',
    '#                # grade = "ISO VG 68", and in [operation] oil_temperature, and oil_flow for the drag;',
    '#                # `jaxbearing new {name} --oil "ISO VG 68" --force` writes them, and this file anew.',
)
"""Lines on laws in a dry file; `{name}` stands for the designation, `{best}` for what `laws = "best"` models."""
BEST_IN_WORDS = {
    "cylindrical": "films, friction, rolling resistance and cage",
    "tapered": "films, friction of the rib and rolling resistance (rollers roll without sliding, without a cage)",
}
"""Effects that `laws = "best"` models besides the drag, by kind of roller bearing."""
BEST_OF_BALLS = "films, friction, attitude of the balls, rolling resistance and cage"
LAWS = (
    'laws = "best"  # {best};',
    "#              # with oil_flow drag too.",
    '#              # A field of your own prevails; [contact] rolling_resistance = "none" leaves that one out.',
)
"""Lines on laws in a file with an oil."""

CLEANLINESS_HINT = (
    "# The cleanliness of the oil gives the modified life: an ISO 4406 code (an example), or a class (grease_normal).",
    '# cleanliness = "-/17/14"',
)
"""Lines on cleanliness in the table `rating`; only with an oil, whose viscosity ratio the modified life needs."""


def scene_text(bearing: Designation, geometry: Geometry, known: Mapping[str, float], duty: Duty) -> str:
    """The file: boundary dimensions, internal geometry with intervals, materials, rating, oil and operation."""
    kind = KINDS.get(bearing.kind, "ball_bearing")
    dry = duty.oil is None
    words = {"name": bearing.text, "best": best_in_words(bearing)}
    laws = [line.format(**words) for line in (LAWS_HINT if dry else LAWS)]
    parts = [*_head(bearing, geometry, known), "", f'kind = "{kind}"', *laws, ""]
    parts += _table("geometry", list(_geometry(bearing, geometry)))
    if bearing.design in ("NJ", "NUP"):
        side = '"both"' if bearing.design == "NUP" else '"+x"'
        parts += [
            f"# The flanges of type {bearing.design} carry axial loads once their stiffness is given (examples):",
            '# flange_stiffness = "60 N/um^(10/9)"',
            '# flange_gap       = "0.1 mm"',
            f"# thrust           = {side}",
            "",
        ]
    elements = "balls" if kind == "ball_bearing" else "rollers"
    balls = (
        Line(elements, '"Si3N4"', "as the designation states")
        if bearing.ceramic
        else Line(elements, '"52100"', "assumed")
    )
    parts += _table("materials", [Line("rings", '"52100"', "assumed"), balls])
    if dry and kind == "ball_bearing":
        parts += _table("kinematics", [Line("attitude", '"outer"', 'of a dry scene: take it out with laws = "best"')])
    if not dry:
        parts += _table("oil", list(oil_lines(duty)))
    rating = list(_rating(known))
    left = {0: "C and C0 are", 1: "the other rating is"}.get(len(rating))
    parts += _table("rating", rating, f"  # {left} computed from the geometry" if left else "")
    if not dry:
        # into the table, whose last line is empty
        parts[-1:] = [*CLEANLINESS_HINT, ""]
    name = Line("designation", quoted(bearing.text), "for `jaxbearing compare`: no result depends on it")
    parts += _table("catalogue", [name])
    mean = 0.5 * (bearing.bore + bearing.outside)
    capacity = known.get("dynamic_capacity", geometry.dynamic_capacity)
    parts += _table("operation", list(operation_lines(duty, bearing.kind, mean, capacity)))
    if bearing.kind == "tapered":
        parts += [*_middle(geometry), ""]
    parts += _hints(bearing)
    return "\n".join(parts).rstrip() + "\n"


def sharper(bearing: Designation, known: Mapping[str, float]) -> str:
    """Options of the command that would narrow the estimates; empty if everything is given."""
    rollers = bearing.kind in ("cylindrical", "tapered")
    options = {
        "static_capacity": "--static-capacity",
        "dynamic_capacity": "--dynamic-capacity",
        "n_elements": "--rollers" if rollers else "--balls",
        "diameter": "--roller-diameter" if rollers else "--ball-diameter",
        "pitch_diameter": "--pitch-diameter",
    }
    if rollers:
        options["length"] = "--roller-length"
    if bearing.kind not in ("deep_groove", "cylindrical") and bearing.contact_angle is None:
        options["contact_angle"] = "--contact-angle"
    return ", ".join(option for name, option in options.items() if name not in known)


def _head(bearing: Designation, geometry: Geometry, known: Mapping[str, float]) -> Iterator[str]:
    sizes = f"{bearing.bore:g} x {bearing.outside:g} x {bearing.width:g} mm"
    yield f"# {bearing.text}: {bearing.in_words}, {sizes} (bore, outside diameter, width)."
    yield "# Boundary dimensions are standard. What is marked `estimated` is not a maker's number: it follows from"
    yield f"# usual proportions{_known_in_words(known)}. The intervals hold 90 % of what is likely."
    dynamic, static = _kilo(geometry.dynamic_capacity), _kilo(geometry.static_capacity)
    yield f"# Ratings of this geometry, computed: C = {dynamic} (ISO 281), C0 = {static} (limits of ISO 76)."
    options = sharper(bearing, known)
    if options:
        yield f"# What would sharpen the estimates: {options}."
    for note in bearing.notes:
        yield f"# {note}" if note.endswith("?") else f"# {note}."


def _known_in_words(known: Mapping[str, float]) -> str:
    words = {
        "dynamic_capacity": lambda value: f"C = {kilonewtons(value)}",
        "static_capacity": lambda value: f"C0 = {kilonewtons(value)}",
        "n_elements": lambda value: f"{value:g} rolling elements",
        "diameter": lambda value: f"an element diameter of {text_in('mm', value, LENGTH)}",
        "pitch_diameter": lambda value: f"a pitch diameter of {text_in('mm', value, LENGTH)}",
        "length": lambda value: f"a roller length of {text_in('mm', value, LENGTH)}",
        "contact_angle": lambda value: f"a contact angle of {text_in('deg', value, ANGLE)}",
    }
    texts = [words[name](value) for name, value in known.items()]
    return f" and from {', '.join(texts)}" if texts else ", without any rating"


def _geometry(bearing: Designation, geometry: Geometry) -> Iterator[Line]:
    if bearing.kind == "tapered":
        yield from _tapered(bearing, geometry)
    elif bearing.kind == "cylindrical":
        yield from _cylindrical(bearing, geometry)
    else:
        yield from _balls(bearing, geometry)
    for name, value in (("bore", bearing.bore), ("outside_diameter", bearing.outside), ("width", bearing.width)):
        yield Line(name, f'"{value:g} mm"', "standard")


def _balls(bearing: Designation, geometry: Geometry) -> Iterator[Line]:
    yield Line("n_balls", f"{geometry.n_elements.value:g}", _interval(geometry.n_elements))
    size = _millimetres(geometry.diameter)
    yield Line("ball_diameter", f'"{_size(geometry.diameter, 6)}"', size + _usual(geometry))
    yield _pitch(geometry)
    for race, conformity in (("inner", geometry.conformity_inner), ("outer", geometry.conformity_outer)):
        value, least, greatest = conformity[:3] if bearing.kind == "spindle" else GROOVES[race]
        yield Line(f"conformity_{race}", f"{value:.4g}", f"estimated: {least:.4g} to {greatest:.4g}")
    if bearing.kind == "deep_groove":
        yield _clearance(bearing)
    else:
        yield _angle(bearing, geometry.contact_angle)


def _cylindrical(bearing: Designation, geometry: Geometry) -> Iterator[Line]:
    yield Line("n_rollers", f"{geometry.n_elements.value:g}", _interval(geometry.n_elements))
    yield _pitch(geometry)
    size = _millimetres(geometry.diameter)
    yield Line("roller_diameter", f'"{_size(geometry.diameter, 6)}"', size + _usual(geometry))
    yield _length(geometry)
    yield _clearance(bearing)


def _pitch(geometry: Geometry) -> Line:
    pitch = geometry.pitch_diameter
    return Line("pitch_diameter", f'"{_size(pitch)}"', _millimetres(pitch))


def _length(geometry: Geometry) -> Line:
    return Line("roller_length", f'"{_size(geometry.length)}"', _millimetres(geometry.length) + ", effective")


def _tapered(bearing: Designation, geometry: Geometry) -> Iterator[Line]:
    shape = shape_of(geometry)
    yield Line("n_rollers", f"{geometry.n_elements.value:g}", _interval(geometry.n_elements))
    middle = _millimetres(geometry.diameter)
    comment = f"of the big end; at mid length {_size(geometry.diameter)}, {middle}"
    # with enough digits that given numbers can be recovered
    digits = 12 if geometry.diameter.given or geometry.pitch_diameter.given else 6
    yield Line("roller_diameter", f'"{_mm(shape.roller_diameter, digits)}"', comment)
    yield _length(geometry)
    yield _angle(bearing, geometry.contact_angle)
    pitch = f"pitch diameter {_size(geometry.pitch_diameter)}, {_millimetres(geometry.pitch_diameter)}"
    yield Line("roller_half_angle", f'"{_degrees(shape.half_angle, digits)}"', f"from the apex and the {pitch}")
    yield Line("flange_angle", f'"{_degrees(shape.flange_angle)}"', "estimated: contact of the rib near the rim")
    yield Line("end_radius", f'"{_mm(shape.end_radius)}"', "estimated: 0.95 of the roller cone's length, 0.85 to 0.99")


def shape_of(geometry: Geometry) -> TaperedShape:
    """Cones and ends of the rollers of a tapered roller bearing."""
    sizes = (geometry.diameter, geometry.pitch_diameter, geometry.length, geometry.contact_angle)
    return tapered_shape(*(size.value for size in sizes))


def best_in_words(bearing: Designation) -> str:
    """Text that names the effects that `laws = "best"` models in such a bearing besides the drag."""
    return BEST_IN_WORDS.get(bearing.kind, BEST_OF_BALLS)


def _middle(geometry: Geometry) -> Iterator[str]:
    """Comment lines with the axial position of the middle of the roller row, from the apex as in `bearings.tapered`."""
    shape, length = shape_of(geometry), geometry.length.value
    along = 0.5 * shape.roller_diameter / math.tan(shape.half_angle) - 0.5 * length * math.cos(shape.half_angle)
    place = -along * math.cos(geometry.contact_angle.value - shape.half_angle)
    yield "# Loads across the axis act at the apex of the cones; at the middle of the rollers with this in [operation]:"
    yield f'# load_position = "{_mm(place, 4)}"'


def _clearance(bearing: Designation) -> Line:
    limits = clearance_limits(bearing.kind, bearing.clearance_class, bearing.bore)
    if limits is None:
        value = UNKNOWN_CLEARANCE[bearing.clearance_class] * bearing.bore
        comment = f"estimated: {0.5 * value:.0f} to {1.5 * value:.0f} um, beyond the table"
        return Line("diametral_clearance", f'"{value:.0f} um"', f"{comment}; unmounted")
    name = "normal class" if bearing.clearance_class == "CN" else f"class {bearing.clearance_class}"
    comment = f"unmounted, {name} of ISO 5753-1: {limits[0]:g} to {limits[1]:g} um"
    return Line("diametral_clearance", f'"{0.5 * sum(limits):g} um"', comment)


def _angle(bearing: Designation, angle: Estimate) -> Line:
    comment = _interval(angle, 180.0 / math.pi, " deg")
    if angle.given and bearing.contact_angle is not None and angle.value == math.radians(bearing.contact_angle):
        comment = "as the designation states"
    value = text_in("deg", angle.value, ANGLE) if angle.given else _degrees(angle.value)
    return Line("contact_angle", f'"{value}"', comment)


def _rating(known: Mapping[str, float]) -> Iterator[Line]:
    for name in ("dynamic_capacity", "static_capacity"):
        if name in known:
            yield Line(name, f'"{kilonewtons(known[name])}"', "given")


def _hints(bearing: Designation) -> Iterator[str]:
    yield "# Seats make the clearance of the running bearing a result (classes and size are examples):"
    yield "# [fits]"
    yield '# shaft_tolerance   = "k5"'
    yield '# housing_tolerance = "H7"'
    yield f'# housing_outside   = "{1.5 * bearing.outside:g} mm"'


def _table(name: str, lines: list[Line], comment: str = "") -> Iterator[str]:
    """A table with its fields in columns."""
    yield f"[{name}]{comment}"
    wide = max((len(line.name) for line in lines), default=0)
    long = max((len(line.value) for line in lines), default=0)
    for line in lines:
        text = f"{line.name:{wide}} = {line.value:{long}}"
        yield f"{text}  # {line.comment}" if line.comment else text.rstrip()
    yield ""


def _interval(estimate: Estimate, scale: float = 1.0, unit: str = "") -> str:
    if estimate.given:
        return "given"
    return f"estimated: {scale * estimate.least:.4g} to {scale * estimate.greatest:.4g}{unit}"


def _millimetres(estimate: Estimate) -> str:
    return _interval(estimate, 1e3, " mm")


def _usual(geometry: Geometry) -> str:
    return ", a usual size" if geometry.standard_size else ""


def _size(estimate: Estimate, significant: int = 4) -> str:
    """A length as text: to the last digit if it is given, otherwise with this number of digits."""
    return text_in("mm", estimate.value, LENGTH) if estimate.given else _mm(estimate.value, significant)


def _mm(value: float, significant: int = 6) -> str:
    return f"{1e3 * value:.{significant}g} mm"


def _degrees(value: float, significant: int = 5) -> str:
    return f"{math.degrees(value):.{significant}g} deg"


def _kilo(value: float) -> str:
    return f"{1e-3 * value:.4g} kN"


def kilonewtons(force: float) -> str:
    """A given force as text in kN, to its last digit."""
    return text_in("kN", force, FORCE)
