"""`jaxbearing study` through the command line: what it refuses. Its numbers: tests/bearings/test_claims.py."""


def test_refuses_what_has_no_power_loss(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "turbine_roller", "--set", "cage=none", "--set", "contact.traction=none")
    assert code == 2
    assert "without power loss" in err


def test_refuses_other_scenes(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "two_disk_etm")
    assert code == 2
    assert "expected a cylindrical roller or ball bearing" in err


def test_refuses_a_picture_of_another_kind(jaxbearing_command):
    code, _, err = jaxbearing_command("study", "--plot", "page.txt")
    assert code == 2
    assert "--plot" in err
