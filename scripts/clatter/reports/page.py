"""The page: one file with its style, its script, pictures, tables and the numbers of points, which replaces no other
file but an older page."""

import base64
import hashlib
import json
import os
import re
import subprocess
from html import escape
from pathlib import Path
from urllib.parse import quote

from .._command import write_whole
from .._program import WRONG_USE, ClatterError, program
from ..hdf5_files import FileProblem
from ..plots.data import Output
from ..plots.style import own_style
from .commands import command, command_notes
from .histories import NoHistories, histories
from .pictures import picture
from .points import Points
from .tables import tables

HERE = Path(__file__).resolve().parent
TIME = r", [^,\n]* on one thread|estimated time .*\n|memory .*\n"  # in a plan: not the same on every run or machine
MARK = "<!-- a report of clatter -->"


def write_page(files, path, title, may_run):
    """Writes the page of these files, all of it or nothing, and returns its path."""
    check_place(path)
    with own_style():
        text = page([Output(name) for name in files], title, may_run)
    try:
        write_whole(path, text.encode(errors="backslashreplace"))
    except OSError as error:
        raise FileProblem(f"{path}: cannot be written ({error.strerror}); name another file with -o") from None
    return path


def check_place(path):
    """The page is HTML; an older report may be replaced, any other file not."""
    if path.suffix.lower() in (".pdf", ".md", ".docx", ".txt", ".svg", ".png", ".h5", ".json", ".csv"):
        way_out = f"name it {path.with_suffix('.html')}, which a browser prints as PDF"
        raise ClatterError(f"{path}: a report is a page in HTML; {way_out}", WRONG_USE)
    if not path.parent.is_dir():
        raise FileProblem(f"{path}: there is no folder {path.parent}; make it, or name another file with -o")
    if not os.path.exists(path):
        return
    try:
        with open(path, "rb") as file:
            is_report = path.is_file() and file.read(200).decode(errors="replace").splitlines()[1:2] == [MARK]
    except OSError as error:
        raise FileProblem(f"{path}: cannot be read ({error.strerror}); name another file with -o") from None
    if not is_report:
        raise FileProblem(f"{path}: is no report, so it is kept; name another file with -o, or move that one away")


def page(outputs, title, may_run):
    """The page as text; the same for the same files."""
    charts, script, style = ((HERE / name).read_text(encoding="utf-8") for name in ("charts.js", "page.js", "page.css"))
    script = f"{charts}\n{script}"
    title = title or outputs[0].title or Path(shown_name(outputs[0].path)).stem
    many = len(outputs) > 1
    sections = [section(place, output, may_run, many) for place, output in enumerate(outputs)]
    policy = f"default-src 'none'; img-src data:; style-src {hashed(style)}; script-src {hashed(script)}"
    links = "".join(f'<a href="#file-{i}">{escape(Path(shown_name(o.path)).name)}</a>' for i, o in enumerate(outputs))
    return (
        f"<!doctype html>\n{MARK}\n<html lang=en>\n<head>\n<meta charset=utf-8>\n"
        f'<meta http-equiv=Content-Security-Policy content="{policy}">\n'
        f'<meta name=viewport content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
        f"<style>{style}</style>\n</head>\n<body>\n<header><h1>{escape(title)}</h1>"
        f"<button id=theme type=button hidden>Dark or light</button></header>\n"
        f"{f'<nav>{links}</nav>' if many else ''}\n<main>\n"
        + "\n".join(sections)
        + f"\n</main>\n<script>{script}</script>\n</body>\n</html>\n"
    )


def hashed(content):
    return f"'sha256-{base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()}'"


def section(place, output, may_run, has_title):
    """All of one file."""
    points = Points(output) if not output.is_accuracy else None
    svg, panels, words = picture(output, points)
    name = Path(shown_name(output.path)).stem
    data = {"panels": panels, **(points.packed() if points else {"shape": [0]})}
    notes = []
    try:
        data["histories"] = histories(output, points, may_run)
    except NoHistories as reason:
        notes.append(str(reason))
    if points and not points.are_all:
        notes.append(
            f"The page has the numbers of {' × '.join(map(str, points.shape))} points, evenly spread over the "
            f"{' × '.join(map(str, points.whole))} of the file; a click shows the nearest of them."
        )
    if points:
        data["command"] = command(output, points)
        notes += command_notes(output, f"{name}.toml")
    subject = f"Picture of {output.title or name}"
    explorer = f"""<div class=explorer>
<figure class=picture tabindex=0 role=group aria-label="{escape(subject)}" aria-describedby="how-{place}">
<div class=frame><img alt="{escape(f"{subject}: {words}")}" src="data:image/svg+xml;base64,{encoded(svg)}"></div>
<figcaption class=script id="how-{place}">Click on the picture, or step through the points by the arrow keys, ten at a
time with Shift.</figcaption></figure>
<p class=told role=status></p><aside class=point aria-label="Chosen point"></aside>
</div>"""
    return (
        f'<section class=file id="file-{place}">\n{f"<h2>{escape(output.title or name)}</h2>" if has_title else ""}\n'
        f"<p class=path>{escape(Path(shown_name(output.path)).name)}</p>\n{explorer}\n"
        + "".join(f"<p class=note>{escape(note)}</p>" for note in notes)
        + tables(output, points)
        + how_it_was_made(output, name, may_run)
        + f"\n<script type=application/json>{safe_json(data)}</script>\n</section>"
    )


def encoded(content):
    return base64.b64encode(content.encode()).decode()


def shown_name(path):
    """A file's name as text that has an encoding, whatever its bytes are."""
    return os.fsencode(path).decode(errors="replace")


def safe_json(data):
    """JSON that ends no element of the page; it has no word for numbers that are not finite."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def how_it_was_made(output, name, may_run):
    """Configuration, version and plan."""
    toml, origin = output.config_text, {key: value for key, value in output.origin.items() if value}
    rows = "".join(f"<dt>{escape(key.replace('_', ' '))}</dt><dd>{escape(value)}</dd>" for key, value in origin.items())
    link = (
        f'<a download="{escape(name)}.toml" href="data:text/plain;charset=utf-8,{quote(toml)}">{escape(name)}.toml</a>'
    )
    plan = f"<h4>Plan</h4><pre>{escape(plan_of(toml))}</pre>" if may_run and not output.is_branch else ""
    return (
        f"<details open><summary>How it was made</summary><dl>{rows}</dl><h4>Configuration {link}</h4>"
        f"<pre>{escape(toml)}</pre>{plan}</details>"
    )


def plan_of(toml):
    """The plan as the program prints it, or why there is none."""
    found = program()
    if not found:
        return "There is no program clatter here that could tell it."
    try:
        done = subprocess.run([found, "plan", "-"], input=toml, capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"The program doesn't tell it: {error}"
    return (
        re.sub(TIME, "", done.stdout) if done.returncode == 0 else f"The program doesn't tell it: {done.stderr.strip()}"
    )
