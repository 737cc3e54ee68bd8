"""One rule for the files of all verbs: a `.toml` file that is there needs --force, and a file that the command reads is
never overwritten, by whatever name. Both are refused before any work."""

import shutil

import numpy as np
from fit_results import MEDIAN

from jaxbearing.joint import JointDistribution
from jaxbearing.report.joint_file import write_joint
from jaxbearing.scenes.data_files import builtin_text, oil_text

CLEARANCE = "geometry.diametral_clearance"
SPEEDS = ("--speeds", "1000 rpm:2000 rpm:2")
OIL = ("--set", "oil.name=none", "--set", "oil.file=oil.toml")
WRITERS = {
    "stiffness": (("stiffness", "ball.toml", *SPEEDS, "--ross"), "ball.toml"),
    "solve": (("solve", "oiled.toml", *OIL, "--line-contact", "inner"), "oil.toml"),
    "calibrate": (("calibrate", "ball.toml", "data.csv", "--free", CLEARANCE, "--out"), "ball.toml"),
    "fit": (("fit", "curves.csv", "--scene", "disks.toml", "--out"), "disks.toml"),
    "scenes": (("scenes", "--copy", "ball.toml", "--set", "operation.radial_load=2 kN", "--to"), "ball.toml"),
    "new": (("new", "6207", "--output"), ""),
}
"""Verbs that write `.toml` files -> the command but for the last word, and a file that it reads."""
READERS = {
    "sweep": ("sweep", "ball.toml", "--list", "cases.csv", "--table", "cases.csv"),
    "tolerances": ("tolerances", "ball.toml", "--posterior", "fields.nc", "--out", "fields.nc"),
}
"""Commands that would write a file of results that they read."""


def test_scenes_and_inputs_are_kept(jaxbearing_command, folder):
    scenes = {"ball": "deep_groove_6205", "oiled": "turbine_ball", "disks": "two_disk_etm"}
    texts = {file: builtin_text(name) for file, name in scenes.items()} | {"oil": oil_text("mobil_jet_ii")}
    for file, text in texts.items():
        (folder / f"{file}.toml").write_text(text, encoding="utf-8")
    shutil.copy(MEDIAN, folder / "curves.csv")
    (folder / "data.csv").write_text("operation.radial_load [kN],ring.radial [um]\n1,20\n2,30\n", encoding="utf-8")
    (folder / "cases.csv").write_text("operation.radial_load [kN]\n1\n2\n", encoding="utf-8")
    joint = JointDistribution((CLEARANCE,), np.array([1e-5]), np.array([True]), np.array([[0.01]]))
    write_joint(joint, {CLEARANCE: "m"}, folder / "fields.nc", "a calibration")
    (folder / "mine.toml").write_text("mine", encoding="utf-8")
    (folder / "link.toml").symlink_to("ball.toml")
    before = {file.name: file.read_bytes() for file in folder.iterdir() if file.exists()}
    for verb, (words, read) in WRITERS.items():
        refused = jaxbearing_command(*words, "mine.toml")
        assert (refused.code, refused.out, refused.err.count("\n")) == (2, "", 1), verb
        assert "'mine.toml', a file that exists already; expected a new file, or --force" in refused.err
        for name in (read, *(["link.toml"] if verb == "stiffness" else ())) if read else ():
            refused = jaxbearing_command(*words, name, "--force")
            assert (refused.code, refused.out, refused.err.count("\n")) == (2, "", 1), verb
            assert f"'{name}', which this command reads; expected another file" in refused.err
    for verb, words in READERS.items():
        refused = jaxbearing_command(*words)
        assert (refused.code, refused.out) == (2, ""), verb
        assert "which this command reads" in refused.err
    twice = jaxbearing_command(*WRITERS["calibrate"][0], "a.nc", "--out", "./a.nc")
    assert twice.code == 2
    assert "--out: found 'a.nc', which --out writes" in twice.err
    assert {name: (folder / name).read_bytes() for name in before} == before
    # a scene that is asked for replaces one that is not read
    assert jaxbearing_command(*WRITERS["scenes"][0], "mine.toml", "--force").code == 0
    assert "ball_bearing" in (folder / "mine.toml").read_text(encoding="utf-8")
