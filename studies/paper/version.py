"""Of what the page's numbers are: the package's version, and the commit where there is one."""

import subprocess
import xml.etree.ElementTree as ElementTree

from paper import cases


def git(*arguments):
    """What git says about the repository; None where there is no git, or where it knows nothing of
    it (an unpacked archive)."""
    try:
        done = subprocess.run(
            ["git", "-C", str(cases.REPOSITORY), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            universal_newlines=True,
        )
    except OSError:
        return None
    return None if done.returncode else done.stdout.strip()


def version():
    """Of the package, and of the sources if this is a clone: an archive unpacked inside another
    repository is none."""
    package = ElementTree.parse(cases.REPOSITORY / "package.xml").findtext("version")
    top = git("rev-parse", "--show-toplevel")
    commit = git("rev-parse", "--short=10", "HEAD")
    if top is None or commit is None or not cases.REPOSITORY.samefile(top):
        return package
    unchanged = git("diff", "--quiet", "HEAD", "--", "src", "include", "config") is not None
    return "%s, sources of commit %s%s" % (package, commit, "" if unchanged else " with changes")
