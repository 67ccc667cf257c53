"""What may be measured for a calibration, with its unit."""

UNITS = {
    "pull_off_force": "N",
    "apparent_work_of_adhesion": "J/m^2",
    "detachment_length": "m",
    "crack_length": "m",
}
