"""Opens reports in headless Chromium: no error, no network, numbers of the file at a click, commands that give them
again, steps by keys, print.

usage: report_in_browser.py FOLDER    leaves screenshots and a PDF there; scripts/check.sh report runs it
"""

import base64
import json
import os
import subprocess
import sys
from itertools import combinations
from pathlib import Path

import h5py
import numpy as np
from selenium import webdriver
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from report_runs import ReportRuns, branch_point, is_branch, results_at
from shipped import shipped

CLATTER = os.environ["CLATTER"]
SOURCE = Path(os.environ["CLATTER_SOURCE"])
CONFIGS = SOURCE / "configs"
REPORT = ["/usr/bin/python3", SOURCE / "scripts" / "report.py"]
SWITCHES = "headless no-sandbox disable-gpu disable-quic no-first-run disable-background-networking disable-sync"

SAMPLE = "x0=sobol(-3, 3, 64)", "v0=sobol(-6, 6, 64)", "linked=x0, v0"
FIRST, SECOND = (0.31, 0.62), (0.77, 0.2)  # places of clicks, as shares of a panel
DRIVE = (
    "drive_si",
    ("branch.along=frequency", "branch.range=22 Hz, 28 Hz", "machine.frequency=25 Hz", "machine.phase=1"),
)
SOFT = ("soft_bumper", ("sweep.stop_stiffness=1e2, 1e4, 1e6, inf",))


def pages():
    """Name, command, configuration and settings of each page: all that are shipped, and some of other kinds."""
    for config, command, sets in shipped():
        if config.suffix == ".toml":
            yield config.stem, command, config, sets
    yield "map", "run", CONFIGS / "map_nu_xs.toml", ("observe.word=true",)
    yield "machine_branch", "branch", CONFIGS / f"{DRIVE[0]}.toml", DRIVE[1]
    yield "it's $(touch  made)", "run", CONFIGS / "hysteresis.toml", ()
    yield "sample", "run", CONFIGS / "basins.toml", tuple(f"sweep.{change}" for change in SAMPLE)
    yield "infinite", "run", CONFIGS / f"{SOFT[0]}.toml", SOFT[1]


def make(folder):
    for name, command, config, sets in pages():
        file = folder / f"{name}.h5"
        words = [word for change in sets for word in ("--set", change)]
        quiet = {"check": True, "stdout": subprocess.DEVNULL, "cwd": folder}
        subprocess.run([CLATTER, command, config, "-q", "--force", "-o", file.name, *words], **quiet)
        subprocess.run([*REPORT, file.name, "-o", f"{name}.html"], **quiet)
        yield name


def browser():
    options = webdriver.ChromeOptions()
    for switch in SWITCHES.split():
        options.add_argument(f"--{switch}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options)
    driver.set_window_size(1360, 1000)
    return driver


def open_page(driver, path):
    driver.get(path.as_uri())
    driver.execute_async_script("const done = arguments[0]; window.ready.then(() => done(), (e) => done(String(e)))")


def require(holds, words):
    if not holds:
        raise SystemExit(f"report_in_browser.py: {words}")


def check_quiet(driver, name):
    """No message on the console, and nothing asked of a network."""
    messages = driver.get_log("browser")
    require(not messages, f"{name}: the console says {messages}")
    for entry in driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            url = message["params"]["request"]["url"]
            require(url.startswith(("file:", "data:", "blob:")), f"{name}: asks for {url}")


def numbers(driver):
    """Name and text of each number that the page shows."""
    rows = driver.find_elements(By.CSS_SELECTOR, ".numbers tr")
    return {row.get_attribute("data-name"): row.find_element(By.CSS_SELECTOR, ".number").text for row in rows}


def check_totals(driver, name):
    """A total of the observed time, which isn't that of the picture, says so beside its number."""
    for column in data_in(driver)["columns"]:
        row = f'.numbers tr[data-name="{column["name"]}"]'
        if "over" in column:
            label = driver.find_element(By.CSS_SELECTOR, f"{row} td").get_attribute("textContent")
            require(column["over"] in label, f"{name}: {label} doesn't say that it is {column['over']}")


def data_in(driver):
    return json.loads(driver.find_element(By.CSS_SELECTOR, "section script").get_attribute("textContent"))


def click(driver, box, across, up):
    """Clicks a panel at these shares of its width and height."""
    left, top, right, bottom = box
    image = driver.find_element(By.CSS_SELECTOR, ".picture img")
    x, y = left + across * (right - left), bottom - up * (bottom - top)
    place = driver.execute_script(
        """const [image, x, y] = arguments;
        let box = image.getBoundingClientRect();
        scrollBy(0, box.top + y * box.height - innerHeight / 2);
        box = image.getBoundingClientRect();
        return [Math.round(box.left + x * box.width), Math.round(box.top + y * box.height)];""",
        *(image, x, y),
    )
    actions = ActionBuilder(driver)
    actions.pointer_action.move_to_location(*place).click()
    actions.perform()
    driver.execute_async_script("setTimeout(arguments[0], 50)")


def check_point(driver, folder, name):
    """The numbers of the page are those of the file at the place that it names, and its command gives them again."""
    file, data = folder / f"{name}.h5", data_in(driver)
    index = tuple(kept[i] for kept, i in zip(data["whole"], driver.execute_script("return explorers[0].chosen")))
    labels = [label.text for label in driver.find_elements(By.CSS_SELECTOR, ".steps .value")]
    shown, compared = numbers(driver), 0
    there = branch_point(file, index[0])[0] if is_branch(file) else results_at(file, index)
    with h5py.File(file) as opened:
        for axis, place, label in zip(data["axes"], index, labels):
            require(float(label) == opened[axis["name"]][place], f"{name}: {axis['name']} is {label} at {place}")
    for result, value in there.items():
        if result in shown and np.ndim(value) == 0 and result != "status":
            same = shown[result] == (value or "–") if isinstance(value, str) else number(shown[result]) == float(value)
            same = same or not isinstance(value, str) and np.isnan(value) and shown[result] == "–"
            require(same, f"{name} at {index}: {result} is {shown[result]}, in the file {value}")
            compared += 1
    require(compared > 1, f"{name}: only {compared} numbers to compare in {shown}")
    runs = ReportRuns()
    runs.directory = folder
    runs.assert_repeats(
        driver.find_element(By.CSS_SELECTOR, ".command code").get_attribute("textContent"), file.name, index
    )
    return index


def check_place(driver, folder, name, panel):
    """The point that is shown lies as near to the click as any, to a pixel or two, along every axis of the panel."""
    chosen, whole = driver.execute_script("return explorers[0].chosen"), data_in(driver)["whole"]
    for side, place in enumerate(panel.get("axes", ())):
        axis, to_scale = data_in(driver)["axes"][place]["name"], np.log if panel["log"][side] else np.asarray
        low, high = to_scale(panel["limits"][2 * side : 2 * side + 2])
        with h5py.File(folder / f"{name}.h5") as file:
            away = np.abs((to_scale(file[axis][:][whole[place]]) - low) / (high - low) - FIRST[side])
        require(away[chosen[place]] <= away.min() + 0.01, f"{name}: the click shows {axis} number {chosen[place]}")


def number(text):
    return float("nan" if text == "–" else text)


def check_charts(driver, name):
    """No text of a chart of motion is cut, and none lies on another."""
    for chart in driver.find_elements(By.CSS_SELECTOR, "svg.history"):
        boxes = driver.execute_script(
            """const frame = arguments[0].getBoundingClientRect();
            return [...arguments[0].querySelectorAll("text")].map((text) => {
              const box = text.getBoundingClientRect();
              return [box.left - frame.left, box.top - frame.top, frame.right - box.right, frame.bottom - box.bottom,
                      box.width, box.height, text.textContent];
            });""",
            chart,
        )
        for left, top, right, bottom, _, _, text in boxes:
            require(min(left, top, right, bottom) > -0.5, f"{name}: '{text}' of a chart is cut")
        for one, other in combinations(boxes, 2):
            apart = one[0] + one[4] <= other[0] + 0.5 or other[0] + other[4] <= one[0] + 0.5
            apart = apart or one[1] + one[5] <= other[1] + 1.5 or other[1] + other[5] <= one[1] + 1.5
            require(apart, f"{name}: '{one[6]}' and '{other[6]}' of a chart lie on each other")


def check_access(driver, name):
    """The picture has a role and a label, and an arrow key tells where the point lies, not all of its numbers."""
    picture = driver.find_element(By.CSS_SELECTOR, ".picture")
    label, alt = picture.get_attribute("aria-label"), picture.find_element(By.CSS_SELECTOR, "img").get_attribute("alt")
    require(picture.get_attribute("role") == "group" and label, f"{name}: the picture has no role or no label")
    require(alt.startswith(f"{label}: ") and len(alt) > len(label) + 5, f"{name}: the text of the picture is '{alt}'")
    live = driver.find_elements(By.CSS_SELECTOR, "section [aria-live], section [role=status]")
    told = [element.get_attribute("textContent") for element in live]
    require(len(told) == 1 and len(told[0]) < 200, f"{name}: a screen reader is told {told}")
    for axis in data_in(driver).get("axes", ()):
        for key in (axis, *axis["linked"]):
            require(f"{key['name']} = " in told[0], f"{name}: no word of {key['name']} in '{told[0]}'")


def check_curves(driver, name):
    """A click on the curve of each value of a family shows that value, and a click on a dot of a scatter its point."""
    data, tried = data_in(driver), 0
    for number, panel in enumerate(data["panels"]):
        if not (panel.get("families") or panel.get("cloud") or panel.get("plane")):
            continue
        for place in driver.execute_script(
            """const [number] = arguments, explorer = explorers[0], panel = explorer.data.panels[number];
            const total = explorer.data.shape.reduce((all, size) => all * size, 1), found = [];
            for (let flat = 0; flat < total && found.length < 60; flat += Math.max(1, Math.floor(total / 60))) {
              let rest = flat;
              explorer.chosen = explorer.data.shape.map((_, axis) => {
                const below = explorer.data.shape.slice(axis + 1).reduce((all, size) => all * size, 1);
                const at = Math.floor(rest / below);
                rest %= below;
                return at;
              });
              const [across, along] = explorer.markedIn(panel);
              const at = [share(panel, 0, across), share(panel, 1, along[0])];
              if (at.every((part) => part > 0.02 && part < 0.98)) found.push([[...explorer.chosen], at]);
            }
            return found;""",
            number,
        )[:8]:
            click(driver, panel["box"], *place[1])
            chosen = driver.execute_script("return explorers[0].chosen")
            tried += chosen == place[0]
            if chosen != place[0]:  # another point may lie there
                away = driver.execute_script(
                    """const panel = explorers[0].data.panels[arguments[0]], along = explorers[0].markedIn(panel)[1];
                    return Math.min(...along.map((value) => Math.abs(share(panel, 1, value) - arguments[1])));""",
                    *(number, place[1][1]),
                )
                require(away < 0.03, f"{name}: a click on {place[0]} shows {chosen}")
    return tried


def check_page(driver, folder, name):
    """A click on every panel that stands for points shows one of them, another click another."""
    open_page(driver, folder / f"{name}.html")
    driver.save_screenshot(str(folder / f"{name}.png"))
    check_point(driver, folder, name)
    check_charts(driver, name)
    check_access(driver, name)
    check_totals(driver, name)
    panels, shape = data_in(driver)["panels"], data_in(driver)["shape"]
    require(bool(panels) == (len(shape) > 0), f"{name}: {len(panels)} panels show {shape} points")
    for panel in panels:
        click(driver, panel["box"], *FIRST)
        check_place(driver, folder, name, panel)
    if panels:
        first = check_point(driver, folder, name)
        click(driver, panels[0]["box"], *SECOND)
        second = check_point(driver, folder, name)
        require(first != second, f"{name}: another click shows the same point, {first}")
        driver.find_element(By.CSS_SELECTOR, ".picture").send_keys(Keys.ARROW_LEFT)
        third = check_point(driver, folder, name)
        require(third != second, f"{name}: the arrow key moves to no other point than {second}")
        driver.save_screenshot(str(folder / f"{name}_point.png"))
        check_charts(driver, name)
    check_curves(driver, name)
    check_quiet(driver, name)


def check_looks(driver, folder):
    """Screenshots for eyes: dark, narrow, printed."""
    open_page(driver, folder / "map.html")
    light = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    driver.execute_cdp_cmd(
        "Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
    )
    dark = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    require(light != dark, "dark mode has the colours of light mode")
    driver.save_screenshot(str(folder / "map_dark.png"))
    driver.find_element(By.ID, "theme").click()
    again = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    require(again == light, "the button doesn't make a dark page light")
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    driver.set_window_size(500, 1000)
    wide = driver.execute_script("return document.documentElement.scrollWidth - innerWidth")
    require(wide <= 0, f"a narrow page is {wide} pixels too wide")
    driver.save_screenshot(str(folder / "map_narrow.png"))
    (folder / "map.pdf").write_bytes(base64.b64decode(driver.print_page()))
    check_quiet(driver, "map")


def main():
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    driver = browser()
    try:
        names = list(make(folder))
        for name in names:
            check_page(driver, folder, name)
        check_looks(driver, folder)
    finally:
        driver.quit()
    print(f"{len(names)} pages: no error, no request, the numbers of the files; pictures of them are in {folder}")


if __name__ == "__main__":
    main()
