"""A disk of a few kibibytes, for tests of what a full one leaves behind."""

import contextlib
import subprocess


@contextlib.contextmanager
def small_disk(place, kibibytes):
    """A disk of this size at a place that doesn't exist yet."""
    place.mkdir()
    try:
        mount = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "clatter-test", place], capture_output=True, text=True
        )
        if mount.returncode != 0:
            raise AssertionError(
                f"this test needs a small disk, and mount -t tmpfs is refused ({mount.stderr.strip()}): run it as "
                "root, in a container with --cap-add SYS_ADMIN, or under unshare -rm"
            )
        try:
            yield place
        finally:
            subprocess.run(["umount", place], check=True)
    finally:
        place.rmdir()
