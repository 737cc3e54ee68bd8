"""Friction torque of a tapered roller bearing 32216 in an oil bath beside the measured one and two makers' formulas.

    python docs/examples/trb_32216.py

Measured: Wingertszahn, Koch, Maccioni, Concli, Sauer, Lubricants 11 (2023) 369, Figures 5 and 6: one bearing on the rig
of MEGT (TU Kaiserslautern), mineral oil FVA3 (ISO VG 100), the level at half a roller's height. The paper prints no
table: the torques were read off its figures by others, to about 5 %. Figure 7 is left out: at nearly the load of
Figure 5 it has half the torque, and its set-up is not understood.

Rollers, their number and pitch diameter are those of the paper. The raceway angles are not in it: that of the cup is
one that others took, that of the cone follows from a common apex. Angle of the rib and radius of the roller ends are
assumed, and the paper's profile is left out. The oil's pressure coefficient follows from Dicke's modulus equation; its
shear constants, for the rib, are assumed.

Nothing is tuned but one number: S = 4.6, the gap at the inlet meniscus over the minimum film (3.45 times the central
film), the same at all points. It is fitted to these torques and explains none of them.
"""

import math

import jaxbearing as jb

STEEL = {"youngs_modulus": "206 GPa", "poisson_ratio": 0.3, "density": "7850 kg/m^3"}
SCENE = {
    "kind": "tapered_roller_bearing",
    "geometry": {
        "n_rollers": 16,
        "roller_diameter": "17.756 mm",
        "roller_length": "22.7 mm",
        "contact_angle": "14.17 deg",
        "roller_half_angle": "1.907 deg",
        "flange_angle": "10.654 deg",
        "end_radius": "253 mm",
    },
    "materials": {"rings": STEEL, "rollers": STEEL},
    "oil": {
        "density": "866.6 kg/m^3",
        "conductivity": "0.134 W/(m*K)",
        "viscosity": {
            "law": "two_viscosities",
            "viscosity_1": "87.7358 cSt",
            "temperature_1": "42 degC",
            "viscosity_2": "60.5913 cSt",
            "temperature_2": "50 degC",
            "pressure_viscosity": "20.126 1/GPa",
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
    "operation": {},
}
MEASURED = (
    (5, 6.0, 0.0, 500, 50, 1300),
    (5, 6.0, 0.0, 2000, 50, 2950),
    (5, 6.0, 0.0, 4000, 50, 3750),
    (5, 6.0, 0.0, 500, 42, 1700),
    (6, 6.0, 6.5, 500, 50, 1500),
    (6, 6.0, 6.5, 1000, 50, 1950),
    (6, 6.0, 6.5, 2000, 50, 2500),
    (6, 6.0, 6.5, 4000, 50, 3250),
    (6, 6.0, 6.5, 500, 42, 2000),
    (6, 6.0, 6.5, 4000, 42, 4450),
)
"""Figure; axial and radial load, kN; speed, rpm; temperature of the outer ring, degC; torque, N mm."""
OVER_MINIMUM, MINIMUM_OVER_CENTRAL = 4.6, 0.75
CATALOGUE = jb.Catalogue(
    designation="32216", bore=80e-3, outside_diameter=140e-3, width=35.25e-3, static_capacity=260e3, axial_factor=1.4
)
"""The bearing for the makers' formulas; the axial factor is assumed."""
STARVED = {"gap_over_central": OVER_MINIMUM * MINIMUM_OVER_CENTRAL}


def scene_at(
    axial: float, radial: float, rpm: float, celsius: float, supply: dict[str, float] | None
) -> jb.TaperedRollerBearing:
    """The bearing at an operating point. **Arguments:** loads, kN; `supply`: table; `None`: flooded."""
    operation = {
        "inner_speed": f"{rpm} rpm",
        "axial_load": f"{axial} kN",
        "oil_temperature": f"{celsius} degC",
    }
    if radial:
        operation["radial_load"] = f"{radial} kN"
    contact = SCENE["contact"] | ({} if supply is None else {"supply": supply})
    return jb.scene_from_mapping(SCENE | {"contact": contact, "operation": operation})


def solved(axial: float, radial: float, rpm: float, celsius: float, supply: dict[str, float] | None) -> jb.Solution:
    """The steady state; arguments as for `scene_at`."""
    return jb.solve(scene_at(axial, radial, rpm, celsius, supply))


def torque(solution: jb.Solution, rpm: float) -> float:
    """Friction torque, N mm."""
    return 1e3 * float(solution.power_loss.total) / (rpm * math.pi / 30.0)


def main() -> None:
    """Prints the table."""
    given, found = "Fa, Fr, kN | rpm | degC | measured, N mm", "flooded | S = 4.6"
    print(f"| {given} | {found} | SKF | Palmgren |")
    print("|---" * 8 + "|")
    for _, axial, radial, rpm, celsius, measured in MEASURED:
        cells = [f"{axial:g}, {radial:g}", f"{rpm}", f"{celsius}", f"{measured}"]
        shown = lambda found, measured=measured: f"{found:.0f} ({found / measured:.2f})"
        for supply in (None, STARVED):
            scene = scene_at(axial, radial, rpm, celsius, supply)
            solution = jb.solve(scene)
            cells.append(shown(torque(solution, rpm)))
        makers = jb.compare(scene, solution, catalogue=CATALOGUE)
        cells += [shown(1e3 * makers[law].total) for law in ("skf", "palmgren_ina")]
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
