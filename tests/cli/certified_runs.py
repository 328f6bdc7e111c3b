"""Random scenes run, certified and verified; the environment's CLATTER and CLATTER_VERIFY are the programs."""

import json
import os
import re
import subprocess
from pathlib import Path

from scene_runs import keys_of, numbers

CLATTER, VERIFY = os.environ["CLATTER"], os.environ.get("CLATTER_VERIFY", "")


def verified(*files):
    """What clatter-verify says of files of certificates."""
    result = subprocess.run([VERIFY, "--json", *files], capture_output=True, text=True, check=False)
    if result.returncode not in (0, 1, 3):
        raise RuntimeError(f"{result.returncode}: {result.stderr}")
    return json.loads(result.stdout)


def verdicts(file):
    """The verdict of clatter-verify on each line of a file."""
    result = subprocess.run([VERIFY, "--json", file], capture_output=True, text=True, check=False)
    told = json.loads(result.stdout)
    by_line = {claim["line"]: claim["verdict"] for claim in told["claims"]}
    by_line |= {int(line): "malformed" for line in re.findall(r"^[^\n]*?:(\d+): ", result.stderr, re.MULTILINE)}
    count = len(Path(file).read_text(encoding="utf-8").splitlines())
    found = [by_line.get(number, "proved") for number in range(1, count + 1)]
    if any(found.count(name) != told[name] for name in ("proved", "refuted", "undecided", "malformed")):
        raise RuntimeError(f"{result.returncode}: {result.stderr}")
    return found


def certified(output, certificates, *words):
    """Writes the certificates of an output; their number, and what was said."""
    command = [CLATTER, "certify", output, "-o", certificates, "--force", *words]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode not in (0, 1):
        raise RuntimeError(f"{result.returncode}: {result.stderr}")
    return len(certificates_in(certificates)), result.stderr


def certificates_in(file):
    """The certificates of a file, without the lines that begin and end a list of them."""
    lines = map(json.loads, Path(file).read_text(encoding="utf-8").splitlines())
    return [line for line in lines if "claim" in line]


def certified_scenes(folder, scenes, time, fixed=""):
    """Runs scenes, or their keys beside fixed ones, in a sweep for each kind, and writes the certificates of all into
    one file."""
    folder, kinds = Path(folder), {}
    for scene in scenes:
        values = scene if isinstance(scene, dict) else keys_of(scene)
        kinds.setdefault(tuple(values), []).append(values)
    whole = folder / "certificates.jsonl"
    with open(whole, "w", encoding="utf-8") as file:
        for count, (keys, alike) in enumerate(kinds.items()):
            lists = "".join(f"{key} = {numbers([values[key] for values in alike])}\n" for key in keys)
            config, output = folder / f"{count}.toml", folder / f"{count}.h5"
            linked = f"[sweep]\n{lists}linked = \"{', '.join(keys)}\"\n"
            config.write_text(f"[scene]\n{fixed}{linked}[time]\n{time}max_impacts = 20000\n[observe]\nextrema = true\n")
            subprocess.run([CLATTER, "run", config, "-o", output, "-q"], check=False)
            certified(output, folder / "kind.jsonl")
            file.write((folder / "kind.jsonl").read_text(encoding="utf-8"))
    return whole


def random_certificates(folder, scenes):
    """Certificates of the steady motions and of transients of scenes."""
    for name, time in (("steady", "max_periods = 600\n"), ("transient", 'mode = "transient"\nduration = 30\n')):
        place = Path(folder) / name
        place.mkdir(parents=True)
        yield certified_scenes(place, scenes, time)
