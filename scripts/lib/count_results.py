#!/usr/bin/env python3
"""Counts test cases in JUnit XML files and tells about those that failed.

usage: count_results.py [--total CHECKS.tsv] [--ctest CTEST.xml] FOLDER...

Cases of Google Test, nose and rostest are counted one by one. A rostest writes its test nodes'
cases to rosunit-NAME.xml and one case per node to rostest-*.xml: the latter counts only where a
node failed without a failing case of its own (it crashed, timed out or wrote nothing). CHECKS.tsv
has one line per check: passed|failed|skipped, name, file with its output.
CTEST.xml is what ctest says of the programs: one that failed without a failing case in its results
(it crashed, ran out of time, or was not found) is a failed case, and the ten slowest cases of all
results are shown.
With --total the last line is "N passed, N failed, N skipped", and the exit status is 1 if any
failed or nothing ran.
"""

import argparse
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

LINES_SHOWN = 40


class Case:
    def __init__(self, name, verdict, text="", seconds=0.0):
        self.name, self.verdict, self.text, self.seconds = name, verdict, text, seconds


def local_name(tag):
    return tag.rsplit("}", 1)[-1]


def cases_of(path):
    """The cases of one XML file; a file that cannot be read is one failed case, since its tests
    left no result."""
    try:
        root = ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, OSError) as error:
        return [Case(path.stem, "failed", "no readable result in %s: %s" % (path, error))]
    cases = []
    for element in root.iter():
        if local_name(element.tag) != "testcase":
            continue
        problems = [child for child in element if local_name(child.tag) in ("failure", "error")]
        skipped = [child for child in element if local_name(child.tag) == "skipped"]
        name = ".".join(part for part in (element.get("classname"), element.get("name")) if part)
        seconds = float(element.get("time") or 0.0)
        if problems:
            texts = [(child.text or child.get("message") or "").strip() for child in problems]
            cases.append(Case(name, "failed", "\n".join(texts), seconds))
        elif (
            skipped
            or element.get("result") == "skipped"
            or element.get("status") in ("notrun", "skipped")
        ):
            reason = (
                (skipped[0].get("message") or skipped[0].text or "").strip()
                if skipped
                else "disabled"
            )
            cases.append(Case(name, "skipped", reason))
        else:
            cases.append(Case(name, "passed", seconds=seconds))
    cases.extend(
        case
        for suite in root.iter()
        if local_name(suite.tag) == "testsuite"
        for case in untold_failures(suite, path)
    )
    return cases


def untold_failures(suite, path):
    """A failed case for a suite that counts more failures than its cases tell: rosunit leaves those
    of a subTest out."""
    stated = sum(int(suite.get(key) or 0) for key in ("failures", "errors"))
    told = sum(local_name(child.tag) in ("failure", "error") for child in suite.iter())
    name = "%s (%s)" % (suite.get("name"), path.stem)
    return (
        [Case(name, "failed", "%d failures without a case: see %s" % (stated - told, path))]
        if stated > told
        else []
    )


def cases_of_folder(folder):
    cases = []
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        found = cases_of(path)
        if path.name.startswith("rostest-"):
            found = [
                case
                for case in found
                if case.verdict == "failed" and not told_by_node(path.parent, case)
            ]
        cases.extend(found)
    return cases


def told_by_node(folder, case):
    """Whether the node behind this case of a rostest has a failing case of its own."""
    node = case.name.rsplit(".", 1)[-1]
    node = node[len("test") :] if node.startswith("test") else node
    path = folder / ("rosunit-%s.xml" % node)
    return path.exists() and any(inner.verdict == "failed" for inner in cases_of(path))


def results_of_program(name, folders):
    """The result files of a test of ctest: NAME, or _ctest_PACKAGE_KIND_NAME by catkin, whose
    rostests have a folder each."""
    for kind in ("gtest", "nosetests", "rostest"):
        head, mark, rest = name.partition("_%s_" % kind)
        if head.startswith("_ctest_") and mark:
            break
    else:
        kind, rest = "gtest", name
    rest = rest[: -len(".test")] if rest.endswith(".test") else rest
    found = [
        path
        for folder in folders
        for path in pathlib.Path(folder).rglob("%s-%s.xml" % (kind, rest))
    ]
    return [
        inner
        for path in found
        for inner in (path.parent.glob("*.xml") if kind == "rostest" else [path])
    ]


def cases_of_ctest(path, folders):
    """A failed case for each program that failed without a failing case in its results, with what
    it said last."""
    cases = []
    for element in ElementTree.parse(path).getroot().iter("testcase"):
        name = element.get("name")
        if element.get("status") == "run" or any(
            inner.verdict == "failed"
            for file in results_of_program(name, folders)
            for inner in cases_of(file)
        ):
            continue
        reason = " ".join(
            failure.get("message") or "" for failure in element.iter("failure")
        ) or element.get("status")
        output = (element.findtext("system-out") or "").strip().splitlines()
        cases.append(Case(name, "failed", "\n".join([reason, *output[-20:]])))
    return cases


def show_slowest(cases):
    slowest = sorted(cases, key=lambda case: -case.seconds)[:10]
    print("the slowest cases:")
    for case in slowest:
        print("%7.1f s  %s" % (case.seconds, case.name))


def cases_of_checks(path):
    cases = []
    for line in pathlib.Path(path).read_text().splitlines():
        verdict, name, output = line.split("\t")
        text = pathlib.Path(output).read_text(errors="replace").strip() if output else ""
        cases.append(Case(name, verdict, text))
    return cases


def show_failures(cases):
    for case in cases:
        if case.verdict != "failed":
            continue
        lines = case.text.splitlines()
        print("FAILED  %s" % case.name)
        if (
            len(lines) > LINES_SHOWN
        ):  # a compiler names the cause first, a program that gives up last
            half = LINES_SHOWN // 2
            lines[half:-half] = ["... %d more lines" % (len(lines) - LINES_SHOWN)]
        for line in lines:
            print("    " + line)


def show_skipped(cases):
    reasons = {}
    for case in cases:
        if case.verdict == "skipped":
            reason = [line for line in case.text.splitlines() if line.strip()][-1:] or [
                "no reason given"
            ]
            reasons.setdefault(reason[0].strip(), []).append(case.name)
    for reason, names in reasons.items():
        print("skipped %d: %s" % (len(names), reason))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--total", metavar="CHECKS.tsv")
    parser.add_argument("--ctest", metavar="CTEST.xml")
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()

    cases = [case for folder in arguments.folders for case in cases_of_folder(folder)]
    if (
        arguments.ctest and pathlib.Path(arguments.ctest).exists()
    ):  # else nothing was built that could be run
        show_slowest(cases)
        cases += cases_of_ctest(arguments.ctest, arguments.folders)
    if arguments.total:
        cases += cases_of_checks(arguments.total)
    count = {
        verdict: sum(case.verdict == verdict for case in cases)
        for verdict in ("passed", "failed", "skipped")
    }
    summary = "%(passed)d passed, %(failed)d failed, %(skipped)d skipped" % count
    if arguments.total:
        show_skipped(cases)
        show_failures(cases)
    print(summary)
    return 1 if arguments.total and (count["failed"] or not count["passed"]) else 0


if __name__ == "__main__":
    sys.exit(main())
