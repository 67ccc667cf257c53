#!/usr/bin/env python3
"""Writes a C++ source with every use that the public headers show, each as the body of a function.

usage: uses.py INCLUDE_FOLDER SOURCE.cpp

A use is an indented block of a comment that ends with a semicolon or a brace; equations do not.
Each header shows one.
"""

import pathlib
import re
import sys

LINE = re.compile(r"///     ( *\S.*)$")
PREAMBLE = """\
// Written by test/consumer/uses.py.
{includes}

namespace mems_stiction {{
/// What a reader would do there.
template <typename... Values>
void use(const Values&...) {{}}
template <typename... Values>
void print(const Values&...) {{}}
void report(const std::string&) {{}}
void reject(const std::string&) {{}}
void stuck() {{}}

"""
# What a use takes as given: the parameters of its function, by header.
GIVEN = {
    "configuration/provenance": "const ScanIdentity& identity, const Configuration& configuration",
    "contact/contact_solution": "const ContactSolution& solution",
    "contact/model_statement": "const Prediction& prediction",
    "device/device_force": "const HeightMap& a, const HeightMap& b, const Options& options, "
    "const UncertaintyOptions& uncertainty",
    "evaluation/convergence": "const HeightMap& scan, AdhesionModel& model",
    "evaluation/half_space_scan": "const Configuration& configuration, "
    "const PreparedScan& prepared",
    "evaluation/prepared_scan": "const Configuration& configuration, const HeightMap& scan, "
    "AdhesionModel& model",
    "evaluation/scan_predictor": "const Configuration& configuration, const HeightMap& scan",
    "half_space/half_space_solution": "const SolvedHalfSpace& solution",
    "half_space/half_space_solver": "const HeightMap& scan",
    "height_map/height_map": "const cv::Mat& heights",
    "height_map/raw_scan": "const cv::Mat& pixels",
    "mechanics/plasticity": "const ContactPair& pair, double composite_rms_height, double radius",
    "paper/paper_options": "Options& options",
    "prediction/adhesion_model": "const cv::Mat& heights",
    "prediction/prediction": "AdhesionModel& model, const SurfacePair& surfaces",
    "preprocess/pipeline": "const HeightMap& scan",
    "roughness/areal_parameters": "const HeightMap& scan",
    "roughness/spatial_roughness": "const HeightMap& scan",
    "roughness/unresolved_waves": "const HeightMap& scan",
    "surface/surface_pair": "const HeightMap& scan, const HeightMap& counter_surface",
    "verdict/beam_adhesion": "const Beam& beam, double apparent_work",
    "verdict/evidence": "const Prediction& prediction, const DeviceOptions& device, "
    "const UncertaintyOptions& uncertainty, const Options& options, double cell_area, "
    "const SolvedHalfSpace& solution",
    "verdict/resolution": "AdhesionModel& model, const HeightMap& scan",
    "verdict/verdict": "const Prediction& prediction, const DeviceOptions& device, "
    "const UncertaintyOptions& uncertainty, const Options& options, const HeightMap& scan, "
    "const Evidence& evidence",
}


def uses_of(text):
    """(number of its first line, its lines) of each use in a header."""
    block, first = [], 0
    for number, line in enumerate(text.split("\n") + [""], 1):
        match = LINE.match(line.strip())
        if match:
            first = first if block else number
            block.append(match.group(1))
            continue
        if block and re.sub(r"\s+//.*", "", block[-1]).endswith((";", "}")):
            yield first, block
        block = []


def source_of(folder):
    headers = sorted((folder / "mems_stiction").rglob("*.hpp"))
    includes = "\n".join('#include "%s"' % path.relative_to(folder) for path in headers)
    text, names = PREAMBLE.format(includes=includes), set()
    for path in headers:
        name = path.relative_to(folder / "mems_stiction").with_suffix("").as_posix()
        for first, lines in uses_of(path.read_text(encoding="utf-8")):
            names.add(name)
            text += 'void use_%s_%d(%s) {\n#line %d "%s"\n%s\n}\n\n' % (
                re.sub(r"\W", "_", name),
                first,
                GIVEN.get(name, ""),
                first,
                path,
                "\n".join(lines),
            )
        if name not in names:
            sys.exit("uses.py: %s shows no use" % path)
    return text + "}  // namespace mems_stiction\n"


if __name__ == "__main__":
    pathlib.Path(sys.argv[2]).write_text(source_of(pathlib.Path(sys.argv[1])), encoding="utf-8")
