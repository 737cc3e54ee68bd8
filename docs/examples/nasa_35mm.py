"""Heat of a 35-mm ball bearing at 28 000 to 72 000 rpm beside that which NASA measured, with three thermal models.

    python docs/examples/nasa_35mm.py

Measured: F. Parker, NASA TP-2275 (1984), Figure 3, read off by others to within 3 %. Balls, races, contact angle, load,
oil flow and inlet temperature are those of the test; conformities, cage, its clearances and the oil are assumed.
Nothing is tuned. No heat goes to the ambient.
"""

import jaxbearing as jb

SCENE = {
    "kind": "ball_bearing",
    "geometry": {
        "n_balls": 16,
        "ball_diameter": "7.14 mm",
        "pitch_diameter": "46.5 mm",
        "contact_angle": "24 deg",
        "conformity_inner": 0.535,
        "conformity_outer": 0.52,
        "width": "14 mm",
    },
    "materials": {"rings": "M50", "balls": "M50"},
    "oil": {"name": "mobil_jet_ii", "heat_capacity": "2150 J/(kg*K)"},
    "contact": {
        "film": "nijenbanning",
        "thermal": "gupta",
        "traction": "maxwell_eyring",
        "traction_accuracy": 1e-3,
        "rolling_resistance": "source_86",
    },
    "kinematics": {"attitude": "equilibrium", "gyroscopic": "off"},
    "cage": {
        "guidance": "inner_ring",
        "guiding_clearance": "300 um",
        "pocket_clearance": "300 um",
        "land_width": "2 mm",
        "n_lands": 2,
        "turbulence": "blend",
    },
    "drag": {"through_flow_fraction": 1.0},
    "operation": {
        "inner_speed": "28000 rpm",
        "axial_load": "667 N",
        "oil_flow": "760 cm^3/min",
        "oil_temperature": "394 K",
    },
}
MEASURED = {28_000: (350.0, 422.0, 413.0), 48_000: (700.0, 443.0, 425.0), 64_000: (1100.0, 458.0, 435.0)}
MEASURED[72_000] = (1400.0, 468.0, 443.0)
"""Speed, rpm -> heat, W; temperatures of inner and outer ring, K, which are not in the report itself."""
CLOSED = {
    1: {"bearing_ambient": "0 W/K"},
    4: {"inner_ring_ambient": "0 W/K", "outer_ring_ambient": "0 W/K"},
}
"""Number of nodes -> conductances that keep all heat in the oil."""


def heat(nodes: int | None, rpm: int) -> tuple[float, str]:
    """Total loss, W, and the temperatures found, K, as a text. **Arguments:** `nodes`: `None`: all at the oil inlet."""
    tables = SCENE | {"operation": SCENE["operation"] | {"inner_speed": f"{rpm} rpm"}}
    if nodes is not None:
        tables["thermal"] = {"nodes": nodes, "ambient": "20 degC", "conductance": CLOSED[nodes]}
    solution = jb.solve(jb.scene_from_mapping(tables))
    if nodes is None:
        return float(solution.power_loss.total), ""
    found = solution.thermal.temperatures
    names = ("bearing",) if nodes == 1 else ("inner_ring", "outer_ring")
    return float(solution.power_loss.total), " / ".join(f"{float(getattr(found, name)):.0f}" for name in names)


def main() -> None:
    """Prints the table."""
    print("| rpm | measured, W | all at oil inlet | one node | T, K | four nodes | T_i / T_o, K | T_i / T_o said |")
    print("|---" * 8 + "|")
    for rpm, (measured, inner, outer) in MEASURED.items():
        cells = [f"{rpm}", f"{measured:.0f}"]
        for nodes in (None, 1, 4):
            total, temperatures = heat(nodes, rpm)
            cells.append(f"{total:.0f} ({100 * (total / measured - 1):+.0f} %)")
            cells += [temperatures] if temperatures else []
        print("| " + " | ".join([*cells, f"{inner:.0f} / {outer:.0f}"]) + " |", flush=True)


if __name__ == "__main__":
    main()
