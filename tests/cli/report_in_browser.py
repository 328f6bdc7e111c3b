"""Opens reports in headless Chromium: no error, no network, numbers of the file at a click, steps by keys, print.

usage: report_in_browser.py FOLDER    leaves screenshots and a PDF there; scripts/check.sh report runs it
"""

import base64
import csv
import json
import os
import shlex
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

from selenium import webdriver
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

CLATTER = os.environ["CLATTER"]
SOURCE = Path(os.environ["CLATTER_SOURCE"])
REPORT = ["/usr/bin/python3", SOURCE / "scripts" / "report.py"]
SWITCHES = "headless no-sandbox disable-gpu disable-quic no-first-run disable-background-networking disable-sync"

RESULTS = ("x_min", "x_max", "period", "settling_periods", "lyapunov", "v_before[1]", "impact_total")

# name: command and words that make its file
PAGES = {
    "map": ("run", "map_nu_xs", "--set", "observe.word=true"),
    "curves": ("run", "fig22"),
    "diagram": ("run", "bifurcation"),
    "basins": ("run", "basins", "--set", "sweep.x0=linspace(-3, 3, 101)", "--set", "sweep.v0=linspace(-6, 6, 101)"),
    "branch": ("branch", "branch"),
    "motion": ("run", "transient"),
    "hysteresis": ("run", "hysteresis"),
}


def make(folder):
    for name, (command, config, *words) in PAGES.items():
        file = folder / f"{name}.h5"
        config = SOURCE / "configs" / f"{config}.toml"
        subprocess.run([CLATTER, command, config, "-q", "-o", file, *words], check=True, stdout=subprocess.DEVNULL)
        subprocess.run([*REPORT, file, "-o", folder / f"{name}.html"], check=True, stdout=subprocess.DEVNULL)


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
    return {row.get_attribute("data-name"): row.text.rsplit(" ", 1)[-1] for row in rows}


def click(driver, across, up):
    """Clicks the first panel at these shares of its width and height."""
    data = json.loads(driver.find_element(By.CSS_SELECTOR, "section script").get_attribute("textContent"))
    left, top, right, bottom = data["panels"][0]["box"]
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


def exported(path, place):
    """The row of `clatter export` at these values of the axes."""
    words = [word for name, value in place.items() for word in ("--where", f"{name}={value}")]
    text = subprocess.run([CLATTER, "export", path, *words], check=True, capture_output=True, text=True).stdout
    return next(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def check_numbers(driver, folder, name):
    """Those of the page are those of the file at the place that the page names."""
    labels = driver.find_elements(By.CSS_SELECTOR, ".steps .value")
    data = json.loads(driver.find_element(By.CSS_SELECTOR, "section script").get_attribute("textContent"))
    place = {axis["name"]: label.text for axis, label in zip(data["axes"], labels)}
    row, shown, compared = exported(folder / f"{name}.h5", place), numbers(driver), 0
    for column, text in shown.items():
        if column not in row or column == "status":
            continue
        there = row[column]
        same = text == "–" if there in ("nan", "") else text == there or float(text) == float(there)
        require(same, f"{name} at {place}: {column} is {text}, in the file {there}")
        compared += 1
    require(compared > 2, f"{name}: only {compared} numbers to compare in {shown}")
    return place


def check_command(driver, folder, name):
    """The command of the point that is shown, with the configuration that the page offers, gives its numbers again."""
    link = driver.find_element(By.CSS_SELECTOR, "details a[download]")
    (folder / link.get_attribute("download")).write_text(unquote(link.get_attribute("href").split(",", 1)[1]))
    command = driver.find_element(By.CSS_SELECTOR, ".command code").text
    words = [CLATTER, *shlex.split(command)[1:], "--force", "-q"]
    subprocess.run(words, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    row, shown = exported(folder / "point.h5", {}), numbers(driver)
    same = [column for column in RESULTS if column in shown and column in row]
    require(same, f"{name}: no number to compare in {row}")
    for column in same:
        require(shown[column].replace("–", "nan") == row[column], f"{name}: {command} gives {column} = {row[column]}")


def check_page(driver, folder, name):
    open_page(driver, folder / f"{name}.html")
    driver.save_screenshot(str(folder / f"{name}.png"))
    if name in ("map", "curves", "diagram", "basins", "hysteresis"):
        click(driver, 0.31, 0.62)
        first = check_numbers(driver, folder, name)
        click(driver, 0.77, 0.2)
        second = check_numbers(driver, folder, name)
        require(first != second, f"{name}: another click shows the same point, {first}")
        driver.find_element(By.CSS_SELECTOR, ".picture").send_keys(Keys.ARROW_RIGHT)
        third = check_numbers(driver, folder, name)
        require(third != second, f"{name}: the arrow key moves to no other point than {second}")
        driver.save_screenshot(str(folder / f"{name}_point.png"))
        if name != "hysteresis":  # its points started where the ones before ended
            check_command(driver, folder, name)
    if name == "branch":
        before = numbers(driver)
        click(driver, 0.5, 0.5)
        require(numbers(driver) != before, "branch: a click shows no other point")
        driver.save_screenshot(str(folder / "branch_point.png"))
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
    make(folder)
    driver = browser()
    try:
        for name in PAGES:
            check_page(driver, folder, name)
        check_looks(driver, folder)
    finally:
        driver.quit()
    print(f"{len(PAGES)} pages: no error, no request, the numbers of the files; pictures of them are in {folder}")


if __name__ == "__main__":
    main()
