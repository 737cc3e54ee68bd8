"""Losses on the raceways of a four-point bearing under mainly radial load, beside the same bearing with two contacts.

python docs/examples/four_point_losses.py
"""

import jaxbearing as jb

AXIAL = (4, 3, 2, 1)
"""Axial loads, kN; the radial load is 5 kN."""
IN_OIL = {
    "operation.inner_speed": "1000 rpm",
    "operation.axial_load": "5 kN",
    "operation.radial_load": "5 kN",
    "operation.oil_temperature": "60 degC",
    "operation.oil_flow": "1 l/min",
    "oil.name": "mobil_jet_ii",
    "contact.film": "hamrock_dowson",
    "contact.traction": "maxwell_eyring",
    "contact.traction_accuracy": "1e-2",
    "kinematics.attitude": "equilibrium",
    "cage.guidance": "inner_ring",
    "cage.guiding_clearance": "400 um",
    "cage.pocket_clearance": "300 um",
    "cage.land_width": "4 mm",
    "cage.n_lands": "2",
    "rating": "none",
}


def bearings() -> dict[str, jb.BallBearing]:
    """`four_point_qj` in oil with a cage, and the same with one arc on each ring and the same contact angle."""
    angle = float(jb.load_scene("four_point_qj").geometry.nominal_angle)
    one_arc = {
        **{"geometry.shim_inner": "none", "geometry.shim_outer": "none", "geometry.diametral_clearance": "none"},
        "geometry.contact_angle": f"{angle!r} rad",
    }
    changes = {"four arcs": IN_OIL, "one arc": IN_OIL | one_arc}
    return {name: jb.load_scene("four_point_qj", change) for name, change in changes.items()}


def row(scene: jb.BallBearing, axial: float) -> tuple[float, int]:
    """Losses of both raceways, W, and most loaded contacts of a ball, under an axial load, kN."""
    found = jb.solve(scene.at_operation(axial_load=1e3 * axial))
    contacts = found.elements.loaded_contacts
    most = 2 if contacts is None else int(contacts.max())
    return float(found.power_loss.inner_raceway + found.power_loss.outer_raceway), most


if __name__ == "__main__":
    scenes = bearings()
    print("| Fa, Fr, kN | four arcs, W | contacts | one arc, W | ratio |\n|---|---|---|---|---|")
    for axial in AXIAL:
        (four, contacts), (two, _) = (row(scene, axial) for scene in scenes.values())
        print(f"| {axial}, 5 | {four:.3g} | {contacts} | {two:.3g} | {four / two:.1f} |", flush=True)
