"""Runs of the project's Python scripts in forks of the test, which has imported their libraries already.

To import matplotlib and h5py takes half a second of processor time, and tests run the scripts hundreds of times. A fork
has its own arguments, environment, directory, outputs and exit code, as a new process has, and runs the same file as
__main__; only the settings of matplotlib are the test's. Guides, and `start_script`, start the scripts as commands.
"""

import os
import runpy
import select
import signal
import subprocess
import sys
import tempfile
import traceback

from command_line import LONGEST, SOURCE

SCRIPTS = SOURCE / "scripts"
sys.path.insert(0, str(SCRIPTS))

import clatter.plots.pictures  # noqa: E402, F401  (from the source tree, so that forks have what they import)
import clatter.reports.page  # noqa: E402, F401


def run_script(name, *words, cwd=None, environment=None, timeout=LONGEST):
    """Runs a script in a fork; returns the same as subprocess.run, with its output as text."""
    command = [str(SCRIPTS / name), *map(str, words)]
    sys.stdout.flush()
    sys.stderr.flush()
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = os.fork()
        if child == 0:
            become(command, out, err, cwd, environment)
        waiting = os.pidfd_open(child)
        try:
            if not select.select([waiting], [], [], timeout)[0]:
                os.killpg(child, signal.SIGKILL)
                os.waitpid(child, 0)
                raise subprocess.TimeoutExpired(command, timeout)
        finally:
            os.close(waiting)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(os.fsdecode(file.read()).replace("\r\n", "\n"))
    return subprocess.CompletedProcess(command, code, *texts)


def start_script(name, *words, cwd=None, environment=None, options=(), timeout=LONGEST):
    """The same of a new interpreter with these options, whose hashes, for one thing, have another seed."""
    command = [sys.executable, *options, str(SCRIPTS / name), *map(str, words)]
    return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, timeout=timeout)


def become(command, out, err, cwd, environment):
    """Goes on as the script, and never returns; a session of its own ends whatever it has started, too."""
    code = 1
    try:
        os.setsid()
        for number, file in ((1, out), (2, err)):
            os.dup2(file.fileno(), number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        sys.stdin, sys.stdout, sys.stderr = (open(n, mode, closefd=False) for n, mode in enumerate("rww"))
        if cwd is not None:
            os.chdir(cwd)
        if environment is not None:
            os.environ.clear()
            os.environ.update(environment)
        sys.argv[:] = command
        code = exit_code(command[0])
        sys.stdout.flush()
        sys.stderr.flush()
    finally:
        os._exit(code)


def exit_code(path):
    """Of a script that runs here, as the interpreter ends with it."""
    try:
        runpy.run_path(path, run_name="__main__")
    except SystemExit as end:
        if end.code is None or isinstance(end.code, int):
            return end.code or 0
        print(end.code, file=sys.stderr)
        return 1
    except BaseException:
        traceback.print_exc()
        return 1
    return 0
