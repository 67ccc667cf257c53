"""Intervals that contain 95 %."""

from statistics import NormalDist

NORMAL_95 = NormalDist().inv_cdf(0.975)  # standard deviations to either side
