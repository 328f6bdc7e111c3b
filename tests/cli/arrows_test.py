"""Rooms of src include only their right-hand neighbours, as the arrows in the guide to src say, and each has its own
namespace."""

import itertools
import os
import re
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["CLATTER_SOURCE"])


def arrows(guide):
    """For each room its right-hand neighbours, from the chains below "The arrows": { a, b } → c → d;  e → f."""
    found = {}
    for chain in re.split(r"[;\n]", re.search(r"## The arrows\s+```text\n(.*?)```", guide, re.DOTALL)[1]):
        links = [re.findall(r"\w+", link) for link in chain.split("→")]
        for left, right in itertools.pairwise(links):
            for room in left:
                found.setdefault(room, set()).update(right)
        for room in itertools.chain(*links):
            found.setdefault(room, set())
    return found


# Room: its right-hand neighbours; what these may include, it may include too. clatter-verify is a program of its own,
# which shares nothing with what it proves.
NEXT = arrows((SOURCE / "src/README.md").read_text(encoding="utf-8")) | {"verify": set()}
# Rooms within a room, by their own arrows, where its guide has any: all files at its top may include all of these.
INNER = {
    guide.parent.name: arrows(text)
    for guide in sorted(SOURCE.glob("src/*/README.md"))
    if "## The arrows" in (text := guide.read_text(encoding="utf-8"))
}
KNOWN_TO = {  # library header: the only rooms that see it
    r"fftw3": {"observables"},
    r"Eigen": {"motion", "branches"},
    r"omp\.h": {"sweep"},
    r"hdf5|H5": {"results"},
    r"toml": {"config"},
    r"zlib": {"storage"},
    r"boost/program_options": {"config", "apps", "verify"},
    r"arb\.h|flint/": {"verify"},
    r"boost/multiprecision": {"math"},
    r"boost/math": {"branches", "observables", "sweep"},
    r"boost/numeric/odeint": {"stepping"},
    r"nettle": {"results"},
    r"boost/random": {"config"},
    r"xsimd": {"lanes"},
    r"nlohmann": {"apps", "certificates", "verify"},
}
HEAVY = {  # what takes seconds to compile: the only files that it reaches through headers, too
    r"boost/multiprecision": {
        "src/accuracy/run_record.cpp",
        "src/point/decided.cpp",
        "src/point/double_double_motions.cpp",
        "src/point/fifty_digit_motions.cpp",
        "src/point/motions_beyond_double.cpp",
        "src/point/reference_fixed_point.cpp",
        "src/point/reference_motion.cpp",
        "src/point/fixed_point_in_housing.cpp",
        "src/stepping/exact_loops_fifty_digits.cpp",
    },
    r"boost/numeric/odeint": {"src/point/dormand_prince_points.cpp", "src/stepping/dormand_prince_loops.cpp"},
    r"boost/math": {
        "src/branches/resting_branch.cpp",
        "src/branches/walk/walk.cpp",
        "src/observables/samples/bracketed_root.cpp",
        "src/observables/energy/quadrature.cpp",
        "src/sweep/binomial_share.cpp",
    },
    r"boost/random": {"src/config/axis_functions.cpp"},
    r"boost/program_options": {
        "src/config/ini_reader.cpp",
        "apps/clatter/terminal/command_line.cpp",
        "apps/verify/main.cpp",
    },
    r"toml": {"src/config/toml_reader.cpp"},
    r"fftw3": {"src/observables/harmonics/fourier_transform.cpp"},
    r"Eigen": {"src/motion/linear_maps.cpp", "src/branches/equations/housing_multipliers.cpp"},
    r"nlohmann": {
        "apps/clatter/help/config_schema.cpp",
        "apps/clatter/tables/json_output.cpp",
        "src/certificates/certificate_text.cpp",
        "apps/verify/certificate.cpp",
        "apps/verify/scene_fields.cpp",
        "apps/verify/json.cpp",
        "apps/verify/result.cpp",
    },
    r"xsimd": {
        "src/lanes/step_block.cpp",
        "src/lanes/step_cushioned_block.cpp",
        "src/lanes/step_unsprung_block.cpp",
    },
    r"stepping/(exact|guided)\.hpp": {
        "src/lanes/block_scheduler.cpp",
        "src/lanes/observe_task.cpp",
        "src/lanes/run_in_lanes.cpp",
        "src/lanes/scalar_fallback.cpp",
        "src/lanes/scheduler.cpp",
        "src/lanes/settle_task.cpp",
        "src/point/decided.cpp",
        "src/point/dormand_prince_points.cpp",
        "src/point/exact_motion.cpp",
        "src/point/exact_points_any_stiffness.cpp",
        "src/point/exact_points_everything.cpp",
        "src/point/exact_points_forced.cpp",
        "src/point/exact_points_free.cpp",
        "src/point/exact_points_friction.cpp",
        "src/point/exact_points_loose_mass.cpp",
        "src/point/exact_points_soft_stops.cpp",
        "src/point/double_double_motions.cpp",
        "src/point/fifty_digit_motions.cpp",
        "src/point/reference_fixed_point.cpp",
        "src/point/reference_motion.cpp",
        "src/point/moreau_points.cpp",
        "src/point/point.cpp",
        "src/stepping/exact_loops.cpp",
        "src/stepping/exact_loops_everything.cpp",
        "src/stepping/exact_loops_fifty_digits.cpp",
        "src/stepping/exact_loops_friction.cpp",
        "src/stepping/exact_loops_loose_mass.cpp",
        "src/sweep/worker_pool.cpp",
    },
    r"stepping/(long_loop|guided)\.hpp": {
        "src/point/double_double_motions.cpp",
        "src/point/fifty_digit_motions.cpp",
        "src/point/reference_fixed_point.cpp",
        "src/stepping/dormand_prince_loops.cpp",
        "src/stepping/exact_loops.cpp",
        "src/stepping/exact_loops_everything.cpp",
        "src/stepping/exact_loops_fifty_digits.cpp",
        "src/stepping/exact_loops_friction.cpp",
        "src/stepping/exact_loops_loose_mass.cpp",
    },
    r"observables/observers\.hpp": {
        "src/lanes/observe_task.cpp",
        "src/point/dormand_prince_points.cpp",
        "src/point/exact_points_any_stiffness.cpp",
        "src/point/exact_points_everything.cpp",
        "src/point/exact_points_forced.cpp",
        "src/point/exact_points_free.cpp",
        "src/point/exact_points_friction.cpp",
        "src/point/exact_points_loose_mass.cpp",
        "src/point/exact_points_soft_stops.cpp",
        "src/point/moreau_points.cpp",
    },
}
WORDS_OF_ALL = {"math", "scene"}  # their namespaces are inline: every room says Scene, Effects, pi without their name


def below(room, following=None):
    """All rooms that a room may include, by the neighbours `following` each, else those of src."""
    following = following or NEXT
    found = set()
    for neighbour in following[room]:
        found |= {neighbour} | below(neighbour, following)
    return found


def is_against_inner(path, room, include, inner):
    """Whether a file in an inner room includes one that isn't to the right of it, or one at the top."""
    inside, target = path.parent.name, include.split("/")
    if inside == room or room not in inner or target[0] != room:
        return False
    return len(target) < 3 or target[1] not in below(inside, inner[room]) | {inside}


def sources(root):
    """Every source file below `root`, with its room."""
    for path in sorted([*root.glob("src/*/**/*.?pp"), *root.glob("apps/*/**/*.?pp")]):
        parts = path.relative_to(root).parts
        yield path, "apps" if parts[:2] == ("apps", "clatter") else parts[1]


def includes(path):
    """The includes of a file: number of the line, opening quote or bracket, and what is included."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if include := re.match(r'\s*#\s*include\s*(["<])([^">]+)', line):
            yield number, include


def reached(root):
    """For each .cpp file below `root`, by its path from there, all that it includes, through headers too."""
    direct = {path: {include[2] for _, include in includes(path)} for path, _ in sources(root)}

    def add(path, found):
        for name in direct.get(path, set()) - found:
            found.add(name)
            for folder in (root / "src", root / "apps/clatter", path.parent):
                add(folder / name, found)
        return found

    return {str(path.relative_to(root)): add(path, set()) for path in direct if path.suffix == ".cpp"}


def heavy_files(root):
    """For each pattern of `HEAVY`, the files that reach what it matches."""
    of_file = reached(root)
    return {
        heavy: {file for file, names in of_file.items() if any(re.match(heavy, name) for name in names)}
        for heavy in HEAVY
    }


def wrong_includes(root, inner=INNER):
    """Every include against the arrows below `root`, as 'file:line: include'."""
    wrong = []
    for path, room in sources(root):
        permitted = below(room) | {room}
        for number, include in includes(path):
            target = include[2].split("/")[0]
            against = include[1] == '"' and target in NEXT and target not in permitted
            foreign = any(re.match(library, include[2]) and room not in seen for library, seen in KNOWN_TO.items())
            if against or foreign or is_against_inner(path, room, include[2], inner):
                wrong.append(f"{path.relative_to(root)}:{number}: {include[2]}")
    return wrong


def wrong_namespaces(root):
    """Every namespace below `root` that isn't its room's, or `detail` in it, and every room that opens another's."""
    wrong = []
    for path, room in sources(root):
        name = "app" if room == "apps" else room
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            opens = line + "".join(lines[number : number + 1]) if line == "namespace clatter {" else line
            own = f"namespace clatter {{inline namespace {name} {{" if room in WORDS_OF_ALL else None
            right = opens == own or re.fullmatch(rf"namespace clatter::{name}(::detail)? \{{", opens)
            borrowed = re.match(r"\s*using namespace (?!clatter|std::|boost)", line)
            if (line.startswith("namespace clatter") and not right) or borrowed:
                wrong.append(f"{path.relative_to(root)}:{number}: {line.strip()}")
    return wrong


def touched_lanes(root):
    """Every line outside the room of lanes that reaches into a lane's array."""
    return [
        f"{path.relative_to(root)}:{number}"
        for path, room in sources(root)
        if room != "lanes"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if ".lane[" in line
    ]


class Arrows(unittest.TestCase):
    def test_no_include_points_against_the_arrows(self):
        self.assertEqual(wrong_includes(SOURCE), [])

    def test_heavy_headers_stay_in_the_files_that_need_them(self):
        """A hundred files compile all that a header includes."""
        is_whole = (SOURCE / "src/scene").exists()  # else a tree that a test of this gate has made
        for heavy, files in heavy_files(SOURCE).items():
            self.assertEqual(files, HEAVY[heavy] if is_whole else set(), heavy)

    def test_every_room_has_its_own_namespace(self):
        self.assertEqual(wrong_namespaces(SOURCE), [])

    def test_every_room_is_known(self):
        self.assertEqual({room for _, room in sources(SOURCE)} - set(NEXT), set())
        for room, known in INNER.items():
            inside = {path.parent.name for path, around in sources(SOURCE) if around == room} - {room}
            self.assertEqual(inside, set(known), room)

    def test_only_lanes_touch_the_array_of_a_lane(self):
        self.assertEqual(touched_lanes(SOURCE), [])

    def test_breaches_of_the_rules_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {
                "src/motion/a.hpp": '#include "math/number.hpp"\n#include "sweep/run.hpp"\n'
                + "namespace clatter::motion {\n",
                "src/observables/b.hpp": '#include "stepping/exact.hpp"\nnamespace clatter {\n',
                "src/scene/d.hpp": "namespace clatter {\ninline namespace scene {\nnamespace clatter::math {\n",
                "src/scene/e.cpp": "namespace clatter {\ninline namespace scene {\n",
                "src/scene/roots.hpp": "#include <boost/math/tools/roots.hpp>\n",
                "src/branches/g.cpp": '#include "branches/walk/g.hpp"\n',
                "src/branches/equations/h.hpp": '#include "branches/walk/g.hpp"\n#include "branches/g.hpp"\n',
                "src/branches/walk/g.hpp": '#include "branches/equations/h.hpp"\n',
                "src/plan/f.cpp": '#include "f.hpp"\n',
                "src/plan/f.hpp": '#include "scene/roots.hpp"\n',
                "src/sweep/c.cpp": "#include <hdf5.h>\n#include <omp.h>\nusing namespace lanes;\nx.lane[0] = 1;\n",
            }.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            self.assertEqual(
                wrong_includes(root, {"branches": {"walk": {"equations"}, "equations": set()}}),
                [
                    "src/branches/equations/h.hpp:1: branches/walk/g.hpp",
                    "src/branches/equations/h.hpp:2: branches/g.hpp",
                    "src/motion/a.hpp:2: sweep/run.hpp",
                    "src/observables/b.hpp:1: stepping/exact.hpp",
                    "src/scene/roots.hpp:1: boost/math/tools/roots.hpp",
                    "src/sweep/c.cpp:1: hdf5.h",
                ],
            )
            self.assertEqual(
                wrong_namespaces(root),
                [
                    "src/observables/b.hpp:2: namespace clatter {",
                    "src/scene/d.hpp:3: namespace clatter::math {",
                    "src/sweep/c.cpp:3: using namespace lanes;",
                ],
            )
            self.assertEqual(touched_lanes(root), ["src/sweep/c.cpp:4"])
            self.assertEqual(heavy_files(root)["boost/math"], {"src/plan/f.cpp"})


if __name__ == "__main__":
    unittest.main()
