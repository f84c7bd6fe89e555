"""Usage: junit.py REPORT_DIR: the JUnit reports, read by junitparser."""
import pathlib
import sys

import junitparser

KINDS = (junitparser.Failure, junitparser.Error, junitparser.Skipped)


def counts(cases):
    """How many cases there are, and how many of each kind."""
    found = [0, 0, 0, 0]
    for case in cases:
        found[0] += 1
        results = list(case.result)
        if len(results) > 1:
            raise ValueError(f"{case.name}: more than one result")
        for result in results:
            found[1 + KINDS.index(type(result))] += 1
            if not result.message:
                raise ValueError(f"{case.name}: no message")
        if not case.name or not case.classname or case.time is None:
            raise ValueError("a case without name, classname or time")
    return found


def told(of):
    return [of.tests, of.failures, of.errors, of.skipped]


def check(text):
    """Problems with a report."""
    try:
        xml = junitparser.JUnitXml.fromstring(text)
        everything = []
        for suite in xml:
            cases = list(suite)
            everything += cases
            if counts(cases) != told(suite):
                return f"{suite.name}: {told(suite)} are {counts(cases)}"
        if counts(everything) != told(xml):
            return f"{told(xml)} are {counts(everything)}"
    except Exception as error:  # whatever the parser throws
        return f"{type(error).__name__}: {error}"
    return None


def broken(text):
    yield text[: len(text) // 2]
    yield text.replace(b"<testsuites", b"<testsuite_s", 1)
    yield text.replace(b'tests="', b'tests="1', 1)
    yield text.replace(b'skipped="', b'skipped="1', 1)
    yield text.replace(b' message="', b' massage="', 1)


files = sorted(pathlib.Path(sys.argv[1]).glob("*.junit"))
bad = 0
for file in files:
    text = file.read_bytes()
    problem = check(text)
    if problem:
        bad += 1
        print(f"{file.name}: {problem}", file=sys.stderr)
    for wrong in broken(text):
        if wrong != text and check(wrong) is None:
            bad += 1
            print(f"{file.name}: a broken report is taken", file=sys.stderr)
print(f"{len(files)} JUnit reports read by junitparser")
sys.exit(1 if bad or not files else 0)
