"""The checks of the guides that run nothing: links, anchors, paths, lengths, equations, authors."""

import re

TOP = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
FOLDERS = ("src", "apps", "configs", "scripts", "tests")
MOTION = "src/motion/README.md"  # has the equations and the references

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
INLINE = re.compile(r"`[^`\n]+`")
PATH = re.compile(r"(?<![\w./~-])(?:src|apps|configs|scripts|tests|\.ci)/[\w./*-]*")
EQUATIONS = re.compile(r"\beqs?\.\s+\d+(?:\s*(?:,|and|\.\.\.|…|–|-)\s*\d+)*")
NAME = r"[A-Z][a-zà-ÿ]+"
AUTHORS = re.compile(rf"\b({NAME}(?: (?:&|and) {NAME})*)(?: et al\.)?,? \(?((?:19|20)\d\d)\b")


class Guide:
    """A Markdown file: its lines by what they are, and its text without code."""

    def __init__(self, root, path):
        self.path, self.name = path, str(path.relative_to(root))
        self.lines = path.read_text(encoding="utf-8").splitlines()
        self.blocks = []  # language, number of the first line, lines
        self.kinds = []  # of each line: prose, table, code
        fence, before = None, ""
        for number, line in enumerate(self.lines, 1):
            mark = re.match(r"\s*```(\w*)\s*$", line)
            if fence is None and mark:
                fence = (mark[1], number + 1, [])
                self.kinds.append("code")
            elif mark:
                self.blocks.append(fence)
                fence = None
                self.kinds.append("code")
            elif fence:
                fence[2].append(line)
                self.kinds.append("code")
            elif line.startswith("    ") and (not before.strip() or self.kinds[-1] == "code"):
                self.kinds.append("code")
            else:
                self.kinds.append("table" if line.lstrip().startswith("|") else "prose")
            before = line
        if fence:
            raise ValueError(f"{self.name}: a block of code isn't closed")

    @property
    def text(self):
        """All but blocks of code, at its own lines."""
        return "\n".join("" if kind == "code" else line for line, kind in zip(self.lines, self.kinds))

    @property
    def prose(self):
        """That without code in a line."""
        return INLINE.sub(lambda code: " " * len(code[0]), self.text)

    def spans(self):
        """Code in a line, with its number."""
        for match in INLINE.finditer(self.text):
            yield self.line_of(match.start()), match[0].strip("`")

    def line_of(self, place):
        return self.text.count("\n", 0, place) + 1

    def anchors(self):
        """Of its headings, as GitHub makes them."""
        anchors = []
        for line, kind in zip(self.lines, self.kinds):
            heading = re.match(r"#+ (.*)", line)
            if kind != "prose" or not heading:
                continue
            words = LINK.sub(lambda link: link[0][1:].split("]")[0], heading[1]).lower()
            anchor = re.sub(r"[^\w\- ]", "", words).strip().replace(" ", "-")
            again = anchors.count(anchor)
            anchors.append(f"{anchor}-{again}" if again else anchor)
        return anchors


def guides(root):
    """Every guide of the project."""
    paths = [root / name for name in TOP if (root / name).exists()]
    for folder in FOLDERS:
        paths += sorted((root / folder).rglob("README.md"))
    return [Guide(root, path) for path in paths]


def wrong_links(root):
    """Relative links and anchors that lead nowhere, as 'file:line: target'."""
    wrong = []
    for guide in guides(root):
        for match in LINK.finditer(guide.prose):
            target, _, anchor = match[1].partition("#")
            if re.match(r"\w+:", target):
                continue
            path = (guide.path.parent / target).resolve() if target else guide.path.resolve()
            inside = path.is_relative_to(root.resolve()) and path.exists()
            if not inside or (anchor and (path.is_dir() or anchor not in Guide(root.resolve(), path).anchors())):
                wrong.append(f"{guide.name}:{guide.line_of(match.start())}: {match[1]}")
    return wrong


def wrong_paths(root):
    """Files and folders of the project that code names and that aren't there."""
    wrong = []
    for guide in guides(root):
        codes = list(guide.spans())
        for _, first, lines in guide.blocks:
            codes += [(first + i, line) for i, line in enumerate(lines)]
        for number, code in codes:
            for path in PATH.findall(code):
                path = path.rstrip(".")
                there = any(root.glob(path)) if "*" in path else (root / path).exists()
                if not there:
                    wrong.append(f"{guide.name}:{number}: {path}")
    return wrong


def too_long(root):
    """Lines of prose beyond column 119; of the front page all lines beyond column 120, and more than 200 of them."""
    wrong = []
    for guide in guides(root):
        front = guide.name == "README.md"
        if front and len(guide.lines) > 200:
            wrong.append(f"{guide.name}: {len(guide.lines)} lines")
        for number, (line, kind) in enumerate(zip(guide.lines, guide.kinds), 1):
            if len(line) > (119 if kind == "prose" else 120 if front else 10000):
                wrong.append(f"{guide.name}:{number}: {len(line)} columns")
    return wrong


def comments(root):
    """Name, line and text of each comment in the C++ files; those of whole lines that follow each other are one."""
    for folder in ("src", "apps", "tests"):
        for path in sorted([*(root / folder).rglob("*.hpp"), *(root / folder).rglob("*.cpp")]):
            name, begin, held = path.relative_to(root), 0, []
            for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], 1):
                whole, aside = re.match(r"\s*///?<?(.*)", line), re.search(r"\s//[/<]*\s(.*)", line)
                if whole:
                    begin = begin if held else number
                    held.append(whole[1].strip())
                    continue
                if held:
                    yield name, begin, " ".join(held)
                    held = []
                if aside:
                    yield name, number, aside[1]


def numbers_in(citation):
    """The numbers that 'eq. 12, 14 ... 16' names."""
    numbers = []
    for sign, number in re.findall(r"(\.\.\.|…|–|-|)\s*(\d+)", citation):
        numbers += range(numbers[-1] + 1, int(number) + 1) if sign else [int(number)]
    return numbers


def citations(root):
    """Each place that may cite something, and its text: comments of C++ files, and guides but for the references."""
    for name, number, text in comments(root):
        yield f"{name}:{number}", text
    for guide in guides(root):
        text = guide.prose.split("\n## References")[0]
        for number, paragraph in enumerate(text.split("\n\n")):
            yield f"{guide.name}:{text[:text.index(paragraph)].count(chr(10)) + 1}", paragraph.replace("\n", " ")


def wrong_equations(root):
    """Equations that are cited and don't exist, or have a number twice."""
    tags = re.findall(r"\\tag\{(\d+)\}", (root / MOTION).read_text(encoding="utf-8"))
    wrong = [f"{MOTION}: eq. {tag} twice" for tag in sorted(set(tags)) if tags.count(tag) > 1]
    for place, text in citations(root):
        for citation in EQUATIONS.findall(text):
            wrong += [f"{place}: eq. {number}" for number in numbers_in(citation) if str(number) not in tags]
    return wrong


def wrong_authors(root):
    """Works that are cited and not among the references."""
    references = re.split(r"\n- ", (root / MOTION).read_text(encoding="utf-8").split("\n## References")[1])
    wrong = []
    for place, text in citations(root):
        for names, year in AUTHORS.findall(text):
            surnames = re.split(r" (?:&|and) ", names)
            if not any(f"({year})" in work and all(name in work for name in surnames) for work in references):
                wrong.append(f"{place}: {names} {year}")
    return wrong


def wrong_guides_cited(root):
    """Markdown files that comments cite and the project doesn't have."""
    names = {guide.path.name for guide in guides(root)}
    return [
        f"{place}:{number}: {name}"
        for place, number, text in comments(root)
        for name in re.findall(r"\b[\w-]+\.md\b", text)
        if name not in names
    ]
