"""The report page in a real browser without a network: charts drawn, no error, nothing loaded, narrow and wide."""

import json
import re
import shutil
import subprocess
from datetime import UTC, datetime

import pytest

import jaxbearing as jb
from jaxbearing.report.html_report import html_report
from jaxbearing.scenes.inputs import scene_inputs

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
HEIGHT, PATIENCE = 6000, 120
WATCH = """<script>
window.errors = [];
window.addEventListener("error", function (e) { window.errors.push(String(e.message)); });
window.addEventListener("securitypolicyviolation", function (e) { window.errors.push("refused " + e.blockedURI); });
["error", "warn"].forEach(function (kind) { console[kind] = function () {
  window.errors.push(kind + " " + Array.from(arguments).join(" ")); }; });
</script>"""
LOOK = """<!DOCTYPE html><body style="margin:0"><iframe src="page.html" style="width:%dpx;height:%dpx;border:0">
</iframe>
<pre id="found"></pre><script>
window.addEventListener("load", function () { setTimeout(function () {
  var inside = document.querySelector("iframe").contentWindow, page = inside.document;
  var charts = Array.from(page.querySelectorAll(".chart"));
  document.getElementById("found").textContent = JSON.stringify({
    errors: inside.errors,
    loaded: inside.performance.getEntriesByType("resource").map(function (one) { return one.name; })
      .filter(function (name) { return !/^(data|blob):/.test(name); }),
    width: inside.innerWidth,
    content: page.documentElement.scrollWidth,
    charts: charts.map(function (chart) { return [chart.id, chart.querySelectorAll(".trace").length]; }),
    widths: charts.map(function (chart) {
      return (chart.querySelector(".main-svg") || page.body).getBoundingClientRect().width; }),
    drawings: Array.from(page.querySelectorAll("figure > svg")).map(function (one) {
      return one.getBoundingClientRect().width; })
  });
}, 1500); });
</script>"""

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(BROWSER is None, reason="no Chromium or Chrome is installed"),
]


@pytest.fixture(scope="module", params=["turbine_roller", "turbine_ball", "tapered_example"])
def page(request):
    scene = jb.load_scene(request.param)
    return html_report(scene, jb.solve(scene), request.param, scene_inputs(request.param, {}, scene), datetime.now(UTC))


def browse(folder, address, *options):
    fixed = ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files")
    offline = ("--proxy-server=127.0.0.1:9", "--host-resolver-rules=MAP * ~NOTFOUND")
    own = (f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=20000", f"--window-size=1700,{HEIGHT}")
    command = [BROWSER, *fixed, *offline, *own, *options, address]
    return subprocess.run(command, capture_output=True, timeout=PATIENCE, check=True).stdout.decode()


@pytest.mark.parametrize("width", [360, 1600])
def test_in_a_browser(width, page, tmp_path):
    (tmp_path / "page.html").write_text(page.replace("<head>", f"<head>{WATCH}", 1), encoding="utf-8")
    look = tmp_path / "look.html"
    look.write_text(LOOK % (width, HEIGHT), encoding="utf-8")
    dumped = browse(tmp_path, look.as_uri(), "--dump-dom")
    found = json.loads(re.search(r'<pre id="found">(.*?)</pre>', dumped, re.DOTALL)[1])
    assert found["errors"] == []
    assert found["loaded"] == []
    assert found["width"] == width
    # nothing makes the page wider than the screen
    assert found["content"] == width
    # an axial load alone makes curves that are flat: the page has numbers in their place
    expected = set() if "The same at every ball" in page else {"chart-load", "chart-pressure", "chart-film"}
    assert expected <= {name for name, _ in found["charts"]}
    assert all(traces > 0 for _, traces in found["charts"])
    assert all(0.2 * width < chart <= width for chart in found["widths"])
    assert len(found["drawings"]) == 2
    assert all(0.2 * width < drawing <= width for drawing in found["drawings"])


def test_prints(page, tmp_path):
    (tmp_path / "page.html").write_text(page, encoding="utf-8")
    browse(tmp_path, (tmp_path / "page.html").as_uri(), f"--print-to-pdf={tmp_path / 'page.pdf'}")
    printed = (tmp_path / "page.pdf").read_bytes()
    assert printed.startswith(b"%PDF")
    assert 2 <= len(re.findall(rb"/Type\s*/Page\b", printed)) <= 20
