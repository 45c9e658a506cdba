"""Opens the report of a run in headless Chromium and uses its film: `python3 tools/browser/film.py RUN [PICTURES]`.

Plays, orbits, zooms, steps, clicks a unit, and looks for errors in the console, by mouse, keyboard and on a phone. Ends
with exit code 1 if something is wrong. Saves pictures in the folder PICTURES, if it is given.
"""

import sys
from pathlib import Path

from browser import Browser

READY = "window.breakwaterFilm && !window.breakwaterFilm.isStale"
# Lowest contrast of text and of controls (WCAG 2.2, level AA, criteria 1.4.3 and 1.4.11).
TEXT_CONTRAST = 4.5
CONTROL_CONTRAST = 3.0

# Number of colours in the picture of the canvas: a blank one has one.
COLOURS = """(() => {
  const canvas = document.getElementById("film-picture");
  const small = Object.assign(document.createElement("canvas"), { width: 200, height: 120 });
  const context = small.getContext("2d");
  context.drawImage(canvas, 0, 0, 200, 120);
  const data = context.getImageData(0, 0, 200, 120).data;
  const seen = new Set();
  for (let i = 0; i < data.length; i += 4) seen.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
  return seen.size;
})()"""

# Contrast of each text and of the edge of each control with its background.
CONTRASTS = """(() => {
  const numbers = (colour) => (colour.match(/[\\d.]+/g) || []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((c) => c / 255)
    .map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
  const ratio = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
  const ground = (node) => {
    for (let at = node; at; at = at.parentElement) {
      const colour = numbers(getComputedStyle(at).backgroundColor);
      if (colour.length === 3 || colour[3] > 0.5) return colour;
    }
    return [255, 255, 255];
  };
  const found = [];
  for (const node of document.querySelectorAll(".film *")) {
    const style = getComputedStyle(node);
    const box = node.getBoundingClientRect();
    if (box.width === 0 || style.visibility === "hidden" || node.tagName === "OPTION") continue;
    const hasText = [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim());
    if (hasText) found.push(["text", node.textContent.trim().slice(0, 30), ratio(numbers(style.color), ground(node))]);
    if (["BUTTON", "SELECT"].includes(node.tagName)) {
      found.push(["control", node.id, ratio(numbers(style.borderTopColor), ground(node.parentElement))]);
    }
  }
  return found;
})()"""

failures = []


def expect(what, is_true):
    print(f"{'ok  ' if is_true else 'FAIL'} {what}")
    if not is_true:
        failures.append(what)


def desktop(report, pictures):
    with Browser() as page:
        seconds = page.open(report, f"{READY} || document.querySelector('.film-missing')")
        expect(f"the film is shown after {seconds:.1f} s", page.value(f"Boolean({READY})"))
        if failures:
            return
        film = "window.breakwaterFilm"
        expect("the picture is not blank", page.value(COLOURS) > 20)
        page.value("document.getElementById('film').scrollIntoView()")
        if pictures:
            page.screenshot(pictures / "film-wide.png")
            page.screenshot(pictures / "report-wide.png", whole=True)

        page.value("document.getElementById('film-time').focus()")
        page.value(f"{film}.goTo(0)")
        page.wait(READY)
        first = page.value(f"{film}.time()")
        page.value("document.getElementById('film-play').click()")
        page.wait(f"{film}.time() > {first}", 20)
        page.value("document.getElementById('film-play').click()")
        expect("the film plays and pauses", not page.value(f"{film}.isPlaying"))

        box = page.value("(() => { const b = document.getElementById('film-picture').getBoundingClientRect(); "
                         "return [b.left, b.top, b.width, b.height]; })()")
        centre = (box[0] + box[2] / 2, box[1] + box[3] / 2)
        turn, tilt = page.value(f"[{film}.camera.turn, {film}.camera.tilt]")
        page.drag(centre, (centre[0] + 80, centre[1] + 30))
        after = page.value(f"[{film}.camera.turn, {film}.camera.tilt]")
        expect("a drag turns the view", abs(after[0] - turn) > 0.1 and abs(after[1] - tilt) > 0.01)

        page.value("document.getElementById('film-picture').focus()")
        for key, shift, what in [("ArrowLeft", False, "turn"), ("ArrowUp", False, "tilt"), ("+", False, "distance")]:
            before = page.value(f"{film}.camera.{what}")
            page.press(key, shift)
            expect(f"the key {key} changes the {what}", page.value(f"{film}.camera.{what}") != before)
        before = page.value(f"{film}.camera.target[0]")
        page.press("ArrowRight", shift=True)
        expect("shift and an arrow move the view", page.value(f"{film}.camera.target[0]") != before)
        before = page.value(f"{film}.at")
        page.press(".")
        expect("a full stop goes one frame on", page.value(f"{film}.at") > before)
        page.press(" ")
        expect("the space bar plays", page.value(f"{film}.isPlaying"))
        page.press(" ")
        page.press("Home")
        page.wait(READY)

        if page.value(f"Boolean({film}.bodies)"):
            click_unit(page, film, box, pictures)
        for view in page.value("[...document.getElementById('film-view').options].map((option) => option.value)"):
            page.value(f"(() => {{ const list = document.getElementById('film-view'); list.value = '{view}'; "
                       "list.dispatchEvent(new Event('change')); })()")
            page.wait(READY)
            expect(f"the view {view} is not blank", page.value(COLOURS) > 8)
        contrasts(page)
        focus(page)
        keeps_its_view(page, film)
        expect(f"no errors in the console: {page.errors()}", page.errors() == [])


def click_unit(page, film, box, pictures):
    """Finds a unit in the picture and clicks it."""
    page.value(f"(() => {{ {film}.series.forEach((series) => {{ series.visible = series.name === 'Bed'; }}); "
               f"{film}.isStale = true; }})()")
    page.wait(READY)
    place = page.value(f"""(() => {{
      for (let y = 0.02; y < 1; y += 0.02) {{
        for (let x = 0.02; x < 1; x += 0.02) {{
          if ({film}.drawing.bodyAt({film}.camera, {film}.objects(), x, y) > 0) return [x, y];
        }}
      }}
      return null;
    }})()""")
    expect("a unit is in the picture", place is not None)
    if place is None:
        return
    page.click(box[0] + place[0] * box[2], box[1] + place[1] * box[3])
    page.wait(READY)
    words = page.value("document.getElementById('film-facts').textContent")
    expect("a click on a unit shows its numbers", "displacement" in words and "rotation" in words)
    expect("and its curves", page.value("document.querySelectorAll('.film-curve path.line').length") >= 3)
    if pictures:
        page.screenshot(pictures / "film-unit.png")
    page.value(f"(() => {{ {film}.series.forEach((series) => {{ series.visible = true; }}); {film}.isStale = true; }})()")


def contrasts(page):
    for scheme in ["light", "dark"]:
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        found = page.value(CONTRASTS)
        least = {"text": TEXT_CONTRAST, "control": CONTROL_CONTRAST}
        low = [f"{name!r} {ratio:.1f}" for kind, name, ratio in found if ratio < least[kind]]
        expect(f"contrast of {len(found)} texts and controls on a {scheme} page {', '.join(low)}", not low)


def focus(page):
    """Every control can be reached with the tabulator key, and shows that it has the focus."""
    count = page.value("document.querySelectorAll('.film button:not([hidden]), .film select, .film input, .film canvas').length")
    page.value("document.getElementById('film-picture').focus()")
    reached = set()
    for _ in range(3 * count):
        page.press("Tab")
        name = page.value("(() => { const a = document.activeElement; const list = [...document.querySelectorAll('.film *')]; "
                          "return list.indexOf(a); })()")
        if name >= 0:
            reached.add(name)
    expect(f"{len(reached)} of {count - 1} controls after the picture are reached with the tabulator key", len(reached) >= count - 1)
    unnamed = page.value("[...document.querySelectorAll('.film select, .film input')].filter((one) => "
                         "!one.labels?.length && !one.getAttribute('aria-label')).length")
    expect("every list and switch has a name", unnamed == 0)


def keeps_its_view(page, film):
    """A page that loads again, as that of a run in progress, keeps view, time and colours."""
    page.value("(() => { const list = document.getElementById('film-view'); list.value = 'side'; "
               "list.dispatchEvent(new Event('change')); })()")
    page.value(f"{film}.goTo(1)")
    page.wait(READY)
    time = page.value(f"{film}.time()")
    # The page that loads is a new one, without the mark.
    page.value("(() => { window.isOld = true; location.reload(); })()")
    page.wait(f"!window.isOld && {READY}")
    kept = page.value(f"[{film}.view, document.getElementById('film-view').value, {film}.time()]")
    expect(f"a page that loads again keeps its view and time: {kept}", kept[:2] == ["side", "side"] and abs(kept[2] - time) < 1e-6)


def phone(report, pictures):
    with Browser(390, 844, touch=True) as page:
        page.open(report, f"{READY} || document.querySelector('.film-missing')")
        expect("the film is shown on a phone", page.value(f"Boolean({READY})"))
        wide = page.value("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        expect(f"the page is not wider than a phone ({wide} px)", wide <= 0)
        page.value("document.getElementById('film').scrollIntoView()")
        if pictures:
            page.screenshot(pictures / "film-phone.png")
        expect(f"no errors in the console of a phone: {page.errors()}", page.errors() == [])


def without_webgl(report):
    with Browser() as page:
        script = "HTMLCanvasElement.prototype.getContext = () => null;"
        page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        page.open(report, "document.querySelector('.film-missing')")
        words = page.value("document.getElementById('film-note').textContent")
        expect("without WebGL, a sentence points to the pictures", "pictures below" in words)


def main():
    report = Path(sys.argv[1]) / "report.html"
    pictures = Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if pictures:
        pictures.mkdir(parents=True, exist_ok=True)
    print(f"{report}: {report.stat().st_size / 1e6:.1f} MB")
    expect("the page has at most 15 MB", report.stat().st_size <= 15e6)
    desktop(report, pictures)
    phone(report, pictures)
    without_webgl(report)
    sys.exit(1 if failures else 0)


main()
