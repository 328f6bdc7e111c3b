"""Tries the commands of the guides in a directory with nothing but links to the project's folders and the program."""

import json
import os
import re
import shlex
import subprocess
import sys

from command_line import runs_here
from guides import guides

# These install packages, build, measure or run for minutes: of them the words are checked, not run.
SLOW_SCRIPTS = (
    "scripts/reproduce.sh",
    "scripts/test.sh",
    "scripts/check.sh",
    "scripts/fuzz.sh",
    "scripts/bench.sh",
    "scripts/bench_table.py",
    "scripts/bench_processes.py",
    "scripts/hard_cases.py",
    "scripts/effects_ladder.py",
    "scripts/long_checks.sh",
    "scripts/slurm/check.sh",
    "scripts/check_packages.sh",
)
SLOW_PROGRAMS = ("apt", "apt-get", "cpack", "cmake", "ctest", "build/release/tests/")
# The same commands with less to compute: regress_test compares all that is committed, gallery_test draws all starts.
SHORTER = [
    (r"^(clatter accuracy \S+)", r"\1 -q --set time.window=1"),
    (r"^(clatter run configs/optimal_zones\.toml -o shares\.h5)", r"\1 --set 'sweep.nu=linspace(1, 13, 13)'"),
    (r"^(clatter run configs/map_nu_xs\.toml)( --set scene\.)", r"\1 --set 'sweep.nu=linspace(0.5, 1.5, 5)'\2"),
    (r"^scripts/regress\.sh tests/regression", "figures/scripts/regress.sh figures/tests/regression"),
    (r"^scripts/regress\.sh ", "figures/scripts/regress.sh "),
]
if not runs_here("avx512"):
    SHORTER.append(("--arch avx512", "--arch sse2"))

# The files that a guide takes to be there.
SMALL_MAP = (
    '[scene]\nf = -1.0\nxs = 1\nR = 0.7\nh = 0.1\n[sweep]\nnu = "linspace(0.5, 1.5, 17)"\n[observe]\nextrema = true\n'
)
OUTPUTS = {"out/fig16.h5": "fig16", "out/fig22.h5": "fig22", "baseline.h5": "fig22", "new.h5": "fig22"}

# Launchers that a machine may not have: each does to a command what the guide says of it.
LAUNCHERS = {
    "parallel": """words=()
while [[ $1 == --* ]]; do [[ $1 == --joblog ]] && shift; shift; done
while [[ $1 != ::: ]]; do words+=("$1"); shift; done
shift
for value in "$@"; do eval "${words[*]//\\{\\}/$value}"; done
""",
    "mpirun": """[[ $1 == -n ]]
size=$2
shift 2
for ((rank = 0; rank < size; ++rank)); do OMPI_COMM_WORLD_RANK=$rank OMPI_COMM_WORLD_SIZE=$size "$@"; done
""",
    "sbatch": """[[ " $* " == *" --parsable "* ]]
echo 1
""",
}


class Workplace:
    """An empty directory with links to a project, and to a program where its build leaves it."""

    def __init__(self, root, clatter, folder):
        self.root, self.folder = root, folder
        for path in root.iterdir():
            if path.name not in (".git", "build", "out"):
                (folder / path.name).symlink_to(path.resolve())
        build = folder / "build" / "release" / "apps" / "clatter"
        programs = folder / "bin"
        for place in (build, programs):
            place.mkdir(parents=True)
            (place / "clatter").symlink_to(clatter)
        if verify := os.environ.get("CLATTER_VERIFY"):
            (programs / "clatter-verify").symlink_to(verify)
        for name, text in LAUNCHERS.items():
            (programs / name).write_text(f"#!/usr/bin/env bash\nset -euo pipefail\n{text}")
            (programs / name).chmod(0o755)
        self.environment = {
            **os.environ,
            "PATH": f"{programs}:{os.environ['PATH']}",
            "CLATTER": clatter,
            "HOME": str(folder),
            "MPLBACKEND": "Agg",
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONPATH": str(root / "scripts"),  # the module clatter, as if it were installed
        }

    def furnish(self):
        """Makes what guides suppose to be there."""
        (self.folder / "map.toml").write_text(SMALL_MAP)
        (self.folder / "out").mkdir()
        self.make_figures()
        for output, config in OUTPUTS.items():
            self.run("clatter", "run", "-q", f"configs/{config}.toml", "-o", output)

    def make_figures(self):
        """The scripts again, beside the figures alone of all configurations and of what is committed for them."""
        figures = self.folder / "figures"
        for folder, names in (("configs", "fig*.toml"), ("tests/regression", "fig*.txt")):
            (figures / folder).mkdir(parents=True)
            for path in (self.root / folder).glob(names):
                (figures / folder / path.name).symlink_to(path.resolve())
        (figures / "scripts").symlink_to((self.root / "scripts").resolve())
        sums = (self.root / "tests/regression/SHA256SUMS").read_text().splitlines(True)
        kept = [line for line in sums if line.split()[1].startswith("fig")]
        (figures / "tests/regression/SHA256SUMS").write_text("".join(kept))

    def run(self, *words, text=None):
        return subprocess.run(
            words, cwd=self.folder, env=self.environment, input=text, capture_output=True, text=True, timeout=500
        )


def commands(lines):
    """Numbers and words of the commands in a block, those that go on in the next line as one."""
    held, begin = "", 0
    for number, line in enumerate(lines):
        begin = begin if held else number
        held += line
        if held.endswith("\\"):
            held = held[:-1]
            continue
        if held.strip():
            yield begin, held
        held = ""


def presets(root):
    text = json.loads((root / "CMakePresets.json").read_text())
    return {preset["name"] for kind in text.values() if isinstance(kind, list) for preset in kind}


def wrong_words(workplace, words):
    """The fault of a command that isn't run: an option, a name or a package that doesn't exist."""
    program = words[0]
    if program == "apt-get":
        known = (workplace.root / "scripts" / "packages.sh").read_text()
        named = [word for word in words[2:] if not word.startswith("-")]
        return [word for word in named if not re.search(rf"[\s(]{re.escape(word)}[\s)]", known)]
    if program in ("cmake", "ctest"):
        named = [words[i + 1] for i, word in enumerate(words) if word == "--preset"]
        return [name for name in named if name not in presets(workplace.root)]
    if program not in SLOW_SCRIPTS:
        return []  # a program of the build
    page = workplace.run(program, "--help")
    if page.returncode != 0:
        return [f"{program} --help ends with {page.returncode}"]
    wanted = [word for word in words[1:] if re.fullmatch(r"--?[a-z][\w-]*|[a-z]+", word)]
    return [word for word in wanted if not re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", page.stdout)]


def is_slow(word):
    return word in SLOW_SCRIPTS or word.startswith(SLOW_PROGRAMS)


def tried_line(workplace, line):
    """A line as it is run, and what is wrong with that part of it which isn't."""
    wrong, run = [], []
    for part in line.split(" && "):
        words = shlex.split(part, comments=True)
        if words and is_slow(words[0]):
            wrong += wrong_words(workplace, words)
        else:
            for pattern, shorter in SHORTER:
                part = re.sub(pattern, shorter, part)
            run.append(part)
    return " && ".join(run) or ":", wrong


def tried_block(workplace, language, lines):
    """The failures of a block: number of the line in it, and why."""
    if language == "toml":
        result = workplace.run("clatter", "plan", "-", text="\n".join(lines))
        return [(0, result.stderr)] if result.returncode else []
    if language == "python":
        result = workplace.run(sys.executable, "-c", "\n".join(lines))
        return [(0, result.stderr)] if result.returncode else []
    wrong, script = [], ["set -eo pipefail", "trap 'echo \"line $here\"' ERR"]
    for number, line in commands(lines):
        line, faults = tried_line(workplace, line)
        wrong += [(number, fault) for fault in faults]
        script += [f"here={number}", line]
    result = workplace.run("bash", "-c", "\n".join(script))
    if result.returncode:
        stopped = re.findall(r"^line (\d+)$", result.stdout, re.MULTILINE)
        wrong.append((int(stopped[-1]) if stopped else 0, result.stderr or f"ends with {result.returncode}"))
    return wrong


def wrong_blocks(workplace):
    """Every block of commands, Python or TOML that fails, as 'file:line: why'."""
    wrong = []
    for guide in guides(workplace.root):
        for language, first, lines in guide.blocks:
            if language in ("sh", "bash", "python", "toml"):
                for number, why in tried_block(workplace, language, lines):
                    wrong.append(f"{guide.name}:{first + number}: {why.strip()}")
    return wrong


def wrong_spans(workplace):
    """Commands within the text that name what the program or a script doesn't know."""
    pages, wrong = {}, []
    for guide in guides(workplace.root):
        for number, code in guide.spans():
            match = re.match(r"(?:(clatter) ([a-z]+)|(scripts/[\w/]+\.(?:sh|py)))\b(.*)", code)
            if not match:
                continue
            page = ("clatter", "help", match[2]) if match[1] else (match[3], "--help")
            if match[3] and not os.access(workplace.root / match[3], os.X_OK):
                continue  # a part of other scripts
            if page not in pages:
                result = workplace.run(*page)
                pages[page] = result.stdout if result.returncode == 0 else None
            if pages[page] is None:
                wrong.append(f"{guide.name}:{number}: {' '.join(page)} fails")
                continue
            for option in re.findall(r"(?<![\w-])--?[a-z][\w-]*", match[4]):
                known = option == "--help" or re.search(rf"(?<![\w-]){option}(?![\w-])", pages[page])
                if not known:
                    wrong.append(f"{guide.name}:{number}: {option} in '{code}'")
    return wrong
