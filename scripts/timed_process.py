"""Shared by the scripts that time whole processes."""

import os
import pathlib
import subprocess
import sys
import time
from typing import NamedTuple


class Cost(NamedTuple):
    wall: float  # s
    processor: float  # s, of all threads
    memory: float  # MB (1e6 bytes), the largest that was resident


def timed(*command, permitted=(0,), environment=None):
    """The cost of a process; the script ends with the errors of one whose exit code isn't permitted."""
    begin = time.perf_counter()
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in permitted:
        name = pathlib.Path(sys.argv[0]).name
        sys.exit(f"{name}: {' '.join(map(str, command))} fails:\n{errors.decode(errors='replace')}")
    return Cost(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6)
