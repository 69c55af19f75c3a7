"""Pages of films in Chromium: they load, play, scrub and turn, and show what `immerse render` shows."""

import base64
import io
import shutil
import sys
from pathlib import Path

import numpy
from playwright.sync_api import sync_playwright
from skimage.io import imread
from skimage.metrics import structural_similarity

FILMS = Path(sys.argv[1]).resolve()
CHROMIUM = next(path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name)))
# WebGL 2 without a graphics card.
GRAPHICS = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
SIZE = {"width": 1280, "height": 900}
SHOTS = FILMS / "shots"
SHOTS.mkdir(exist_ok=True)


class Page:
    """A page that was opened, with all that it complained of and asked the network for."""

    def __init__(self, browser, film, size=SIZE, scheme="light", phone=False):
        scale = 3 if phone else 1
        self.context = browser.new_context(viewport=size, color_scheme=scheme, has_touch=phone, device_scale_factor=scale, offline=True)
        self.page = self.context.new_page()
        self.complaints = []
        self.page.on("console", lambda message: self.complaints.append(f"{message.type}: {message.text}"))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.asked = []
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto((FILMS / film / "report.html").as_uri())
        self.page.wait_for_selector("#page[data-ready]", timeout=120_000)
        self.film = film

    def box(self, selector):
        """Where something is in the window, once it is there."""
        element = self.page.locator(selector).first
        element.scroll_into_view_if_needed()
        return element.bounding_box()

    def place(self):
        return self.page.evaluate("viewer.place")

    def picture(self):
        """The pixels of the film as they are."""
        url = self.page.evaluate("(() => { viewer.paint(); return viewer.canvas.toDataURL('image/png'); })()")
        return imread(io.BytesIO(base64.b64decode(url.split(",")[1])))[..., :3]

    def close(self):
        others = [url for url in self.asked if not url.startswith(("blob:", "data:"))]
        assert others == [(FILMS / self.film / "report.html").as_uri()], f"{self.film}: it asked for {others}"
        assert not self.complaints, f"{self.film}: {self.complaints}"
        self.context.close()


def looks_as_rendered(browser, film, frame, least=0.95):
    page = Page(browser, film)
    page.page.evaluate(
        """(frame) => {
            Object.assign(viewer.canvas.style, { width: "640px", height: "360px", aspectRatio: "auto" });
            viewer.resized();
            viewer.go(viewer.frames.indexOf(frame));
        }""",
        frame,
    )
    found, wanted = page.picture(), imread(FILMS / film / f"{frame:06}.png")[..., :3]
    assert found.shape == wanted.shape == (360, 640, 3), found.shape
    similarity = structural_similarity(found, wanted, channel_axis=2)
    print(f"{film}, frame {frame}: structural similarity {similarity:.4f}")
    assert similarity >= least, f"{film}, frame {frame}: {similarity}"
    # An empty picture is like any other that is mostly background.
    seen = [numpy.any(picture != picture[0, 0], axis=2) for picture in (found, wanted)]
    both = numpy.sum(seen[0] & seen[1]) / numpy.sum(seen[0] | seen[1])
    assert both > 0.9 and seen[1].mean() > 0.002, f"{film}, frame {frame}: the same places are covered to {both}"
    page.close()


def plays_scrubs_and_turns(browser, film):
    page = Page(browser, film)
    count = page.page.evaluate("viewer.frames.length")
    readings = lambda: page.page.eval_on_selector_all(".panel .heading", "list => list.map((e) => e.textContent)")
    cursor = lambda: page.page.eval_on_selector(".plot .cursor", "line => Number(line.getAttribute('x1'))")
    page.page.select_option("#color", "")
    assert page.place() == count - 1, "it does not open at what the film comes to"
    page.page.evaluate("viewer.go(0)")
    first, read, stood = page.picture(), readings(), cursor()
    page.page.evaluate("viewer.rate = 2")  # a machine without a graphics card takes its time
    page.page.keyboard.press("Space")
    page.page.wait_for_function("viewer.place > 3", timeout=60_000)
    page.page.keyboard.press("Space")
    stopped = page.place()
    page.page.wait_for_timeout(300)
    assert page.place() == stopped, "it goes on after a pause"
    assert not numpy.array_equal(page.picture(), first), "playing changes nothing"
    assert readings() != read and cursor() > stood, "curves do not follow"

    box = page.box("#scrubber")
    page.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert abs(page.place() - (count - 1) / 2) <= 1, page.place()
    page.page.keyboard.press("ArrowRight")
    after = page.place()
    page.page.keyboard.press("ArrowLeft")
    assert page.place() == after - 1
    page.page.keyboard.press("End")
    assert page.place() == count - 1
    page.page.keyboard.press("Home")
    assert page.place() == 0 and numpy.array_equal(page.picture(), first), "the first frame is another one"
    plot = page.box(".plot")
    page.page.mouse.click(plot["x"] + 0.75 * plot["width"], plot["y"] + plot["height"] / 2)
    assert page.place() > count / 2, "a press in a diagram goes nowhere"
    page.page.evaluate("viewer.go(Math.floor(viewer.frames.length / 2))")

    still = page.picture()
    box = page.box("#film")
    middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.page.mouse.move(*middle)
    page.page.mouse.down()
    page.page.mouse.move(middle[0] + 120, middle[1] + 40, steps=4)
    page.page.mouse.up()
    turned = page.picture()
    assert numpy.mean(numpy.any(turned != still, axis=2)) > 0.02, "it cannot be turned"
    page.page.keyboard.press("t")
    assert not numpy.array_equal(page.picture(), turned), "see-through is not"
    page.page.keyboard.press("t")
    for field in page.page.eval_on_selector_all("#color option", "list => list.map((e) => e.value)")[1:]:
        page.page.select_option("#color", field)
        assert page.page.locator(".legend").is_visible() and page.page.locator(".legend b").inner_text(), field
        assert not numpy.array_equal(page.picture(), turned), field
    page.page.select_option("#color", "")
    page.page.keyboard.press("r")
    assert page.page.locator(".legend").is_hidden()
    page.close()


def fits_a_phone_and_the_dark(browser, film):
    for width in (1280, 390):
        for scheme in ("light", "dark"):
            page = Page(browser, film, {"width": width, "height": 844 if width < 500 else 900}, scheme, phone=width < 500)
            wide = page.page.evaluate("document.documentElement.scrollWidth")
            assert wide <= width, f"{film}: the page is {wide} pixels wide, the window {width}"
            ground = page.page.evaluate("getComputedStyle(document.body).backgroundColor")
            brightness = sum(int(part) for part in ground.strip("rgb()").split(",")[:3])
            assert (brightness < 200) == (scheme == "dark"), ground
            page.page.screenshot(path=SHOTS / f"{film}-{scheme}-{width}.png", full_page=True)
            page.close()
    page = Page(browser, film)
    pdf = page.page.pdf(format="A4")
    (SHOTS / f"{film}.pdf").write_bytes(pdf)
    assert len(pdf) > 30_000, "nothing is printed"
    page.close()


def works_without_webgl(play, film):
    browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-3d-apis"])
    page = Page(browser, film)
    assert "there is no WebGL 2" in page.page.locator(".missing").inner_text()
    page.page.keyboard.press("End")
    assert page.place() > 0 and page.page.locator(".panel").count() > 3
    page.close()
    browser.close()


def a_sweep_is_sorted_and_leads_to_its_films(browser, sweep):
    """The page of a sweep: a picture a film, a table that every heading sorts both ways, and ways to the pages of films."""
    page = Page(browser, sweep)
    rows = lambda: page.page.eval_on_selector_all("tbody tr", "list => list.map((e) => e.innerText)")
    as_made = rows()
    assert len(as_made) == 4 == page.page.locator(".sheet img").count(), as_made
    loaded = "list => list.every((image) => image.complete && image.naturalWidth > 100)"
    assert page.page.eval_on_selector_all(".sheet img", loaded), "a picture does not load"
    error = page.page.locator("th", has_text="length error").first
    number = lambda row: float(next(cell for cell in row.split("\t") if cell.endswith(" %"))[:-2])
    error.click()
    assert [number(row) for row in rows()] == sorted(number(row) for row in as_made)
    error.press("Enter")
    assert [number(row) for row in rows()] == sorted((number(row) for row in as_made), reverse=True)
    address = page.page.locator(".sheet a").first.get_attribute("href")
    assert (FILMS / sweep / address).is_file(), address
    page.close()


with sync_playwright() as play:
    browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", *GRAPHICS])
    for film in ("relaxation", "ricci_torus", "breathing_torus"):
        for frame in (1, 30, 60):
            looks_as_rendered(browser, film, frame)
        plays_scrubs_and_turns(browser, film)
        fits_a_phone_and_the_dark(browser, film)
    # Sheets that one can see through and that pass through each other.
    for frame in (4, 30):
        looks_as_rendered(browser, "soap", frame)
    a_sweep_is_sorted_and_leads_to_its_films(browser, "sweep")
    fits_a_phone_and_the_dark(browser, "sweep")
    browser.close()
    works_without_webgl(play, "relaxation")
print("pages: all is well")
