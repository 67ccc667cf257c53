"""Which cases `scripts/test --all` alone runs."""

import os
import unittest

evidence = unittest.skipUnless(os.environ.get("MEMS_STICTION_EVIDENCE"), "evidence: scripts/test --all")
