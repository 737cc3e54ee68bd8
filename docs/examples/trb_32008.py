"""Friction torque of a tapered roller bearing 40 x 68 x 19 (a 32008) in forced oil beside the measured one.

    python docs/examples/trb_32008.py

Measured: Manjunath, Fauconnier, Ost, De Baets, Machines 11 (2023) 801: 12.85 kN axially, mineral oil FVA 3A, flooded, a
rig with a vertical shaft at Ghent. The torques were read off its figures by others, twice: both readings, A and B,
agree at 2200 rpm and differ by up to a factor of two below (docs/examples/measured/trb_32008_torque.csv).

Number and mean diameter of the rollers, their length and both angles are those that Liu et al., Lubricants 10 (2022)
154, give for this bearing. The pitch diameter follows from a common apex. The shear constants of the oil, for the rib,
and its pressure coefficient are assumed. The rib's angle and the radius of the roller ends are estimated by the
package. Nothing is tuned.
"""

import csv
import math
from pathlib import Path

import jaxbearing as jb

STEEL = {"youngs_modulus": "206 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3"}
LENGTH, HALF_ANGLE = 13.66e-3, math.radians(0.5 * (14.17 - 11.17))
"""Roller length, m; half angle of a roller: half the difference of the angles of cup and cone."""
BIG_END = 0.5e-3 * (6.846 + 6.131) + LENGTH * math.sin(HALF_ANGLE)
"""Diameter of the big end, m, whose roller has the mean of both printed diameters at mid length."""
SCENE = {
    "kind": "tapered_roller_bearing",
    "geometry": {
        "n_rollers": 23,
        "roller_diameter": f"{1e3 * BIG_END} mm",
        "roller_length": f"{1e3 * LENGTH} mm",
        "contact_angle": "14.17 deg",
        "roller_half_angle": f"{math.degrees(HALF_ANGLE)} deg",
    },
    "materials": {"rings": STEEL, "rollers": STEEL},
    "oil": {
        "density": "884.1 kg/m^3",
        "conductivity": "0.134 W/(m*K)",
        "viscosity": {
            "law": "two_viscosities",
            "viscosity_1": "90.02 cSt",
            "temperature_1": "40 degC",
            "viscosity_2": "10.41 cSt",
            "temperature_2": "100 degC",
            "pressure_viscosity": "20 1/GPa",
        },
        "rheology": {
            "law": "exponential",
            "viscous_function": "ree_eyring",
            "reference_temperature": "323 K",
            "shear_modulus": "100 MPa",
            "shear_modulus_pressure": "0 1/GPa",
            "shear_modulus_temperature": "0 K",
            "stress": "4 MPa",
            "stress_pressure": "0 1/GPa",
            "stress_temperature": "0 K",
        },
    },
    "contact": {
        "film": "moes",
        "thermal": "gupta",
        "rolling_resistance": "full_range",
        "flange_film": "chittenden",
        "traction": "ree_eyring",
    },
    "operation": {"inner_speed": "2200 rpm", "axial_load": "12.85 kN", "oil_temperature": "55 degC"},
}
MEASURED = Path(__file__).parent / "measured" / "trb_32008_torque.csv"


def measured() -> dict[tuple[int, int], dict[str, float]]:
    """Torque, N mm, of each reading at a speed, rpm, and a temperature of the outer ring, degC."""
    lines = MEASURED.read_text(encoding="utf-8").splitlines()
    found: dict[tuple[int, int], dict[str, float]] = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        for celsius in (55, 65):
            point = found.setdefault((int(row["n_rpm"]), celsius), {})
            point[row["set"]] = 1e3 * float(row[f"M{celsius}C_Nm"])
    return found


def torque(rpm: float, celsius: float) -> float:
    """Friction torque of the flooded bearing, N mm."""
    changes = {"inner_speed": f"{rpm} rpm", "oil_temperature": f"{celsius} degC"}
    solution = jb.solve(jb.scene_from_mapping(SCENE | {"operation": SCENE["operation"] | changes}))
    return 1e3 * float(solution.power_loss.total) / (rpm * math.pi / 30.0)


def main() -> None:
    """Prints the table."""
    print("| degC | rpm | measured, A, N mm | measured, B | flooded | over A | over B |")
    print("|---" * 7 + "|")
    for (rpm, celsius), readings in sorted(measured().items(), key=lambda one: (one[0][1], one[0][0])):
        found = torque(rpm, celsius)
        ratios = " | ".join(f"{found / readings[name]:.2f}" for name in "AB")
        print(f"| {celsius} | {rpm} | {readings['A']:.0f} | {readings['B']:.0f} | {found:.0f} | {ratios} |", flush=True)


if __name__ == "__main__":
    main()
