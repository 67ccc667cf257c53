"""Which cases, and how many repetitions, `scripts/test --all` alone runs."""

import os
import unittest

IS_EVIDENCE = bool(os.environ.get("MEMS_STICTION_EVIDENCE"))
evidence = unittest.skipUnless(IS_EVIDENCE, "evidence: scripts/test --all")


def times(behaviour, more):
    """How often a case repeats what it does: enough to see the behaviour, and more as evidence."""
    return more if IS_EVIDENCE else behaviour
