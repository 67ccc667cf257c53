"""How many files and connections a program may have open at once (RLIMIT_NOFILE, `ulimit -n`)."""

import resource

ENOUGH = 256  # of a program that serves several people
WANTED = 1024  # select() takes no more


def lack_of_open_files():
    """Raises the limit as far as the process may raise its own. A sentence on what is missing if
    there are too few then, else empty."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    unlimited = resource.RLIM_INFINITY
    most = WANTED if hard == unlimited else min(WANTED, hard)
    if soft != unlimited and soft < most:
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
        soft = most
    if soft == unlimited or soft >= ENOUGH:
        return ""
    return (
        "no more than %d files and connections may be open at once, and connections beyond that "
        "are refused: raise the limit to %d or more (ulimit -n; LimitNOFILE= of a systemd service; "
        "docker --ulimit nofile)" % (soft, ENOUGH)
    )
