"""Configurations as text: dictionaries as TOML, changes as the words of --set."""

import json
import numbers

LONGEST_WORD = 100_000  # characters of one --set; the system refuses words of more than 128 KiB


def toml_of(config):
    """The text of a configuration, and the key on each of its lines, e.g. "scene.nu"."""
    lines, keys = [], []
    sections = {key: value for key, value in config.items() if isinstance(value, dict)}
    for name, table in ({"": {key: config[key] for key in config if key not in sections}} | sections).items():
        if name:
            lines.append(f"[{name}]")
            keys.append(name)
        for key, value in table.items():
            lines.append(f"{key} = {toml_value(value)}")
            keys.append(f"{name}.{key}" if name else key)
    return "\n".join(lines) + "\n", keys


def toml_value(value):
    return quoted(value) if isinstance(value, str) else plain_value(value, quoted)


def quoted(text):
    return json.dumps(text, ensure_ascii=False)


def set_words(sections):
    """The words that change keys of sections: {"scene": {"nu": 1}} is --set scene.nu=1."""
    words = []
    for section, table in sections.items():
        if not isinstance(table, dict):
            raise TypeError(f"{section} = {table!r}: changes are dictionaries by section, e.g. scene={{'nu': 1.0}}")
        for key, value in table.items():
            word = f"{section}.{key}={value if isinstance(value, str) else plain_value(value)}"
            if len(word) > LONGEST_WORD:
                raise ValueError(f"{section}.{key} is too long for a command line; put it into the configuration")
            words += ["--set", word]
    return words


def plain_value(value, of_text=str):
    """A truth value, number or list of numbers, such as an array of numpy, to its last bit; in lists also texts, such
    as numbers with units, by `of_text`."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (list, tuple, range)):
        return f"[{', '.join(of_text(item) if isinstance(item, str) else plain_value(item) for item in value)}]"
    raise TypeError(f"{value!r} is no number, text, truth value or list of numbers")
