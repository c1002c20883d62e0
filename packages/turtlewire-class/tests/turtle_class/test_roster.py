"""The roster of a class: ranges of domains and roster files, right and wrong."""

import pytest

from turtle_class import ClassError
from turtle_class.roster import Seat, read_roster, seats_of_domains


@pytest.mark.parametrize(
    ("text", "domains"), [("0", [0]), ("232", [232]), ("231-232", [231, 232]), ("5-5", [5])]
)
def test_the_first_and_the_last_domain(text, domains):
    assert [seat.domain for seat in seats_of_domains(text)] == domains


def test_domains():
    seats = seats_of_domains("1-3, 40")
    assert [seat.domain for seat in seats] == [1, 2, 3, 40]
    assert seats[0].name == "Domain 1"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "write them as 1-30"),
        ("a", "'a' names no domains: write them as 1-30"),
        ("5-3", "the smaller one first"),
        ("1-233", "from 0 to 232"),
        ("1-3,3", "domain 3 belongs to"),
        ("-1", "'-1' names no domains"),
    ],
)
def test_invalid_domains(text, told):
    with pytest.raises(ClassError, match=told):
        seats_of_domains(text)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "name,domain\n# comment\nAna Müller, 1\n\nBjörn,2\n"),
        ("a.csv", '\ufeff"Ana Müller",1\r\nBjörn,2\r\n'),
        ("a.yaml", "# comment\nAna Müller: 1\nBjörn: 2\n"),
    ],
)
def test_a_roster(tmp_path, name, text):
    (tmp_path / name).write_text(text, encoding="utf-8")
    assert read_roster(tmp_path / name) == [Seat("Ana Müller", 1), Seat("Björn", 2)]


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.csv", "Ana,1\nBjörn\n", r"a\.csv, line 2: 'Björn': write a line"),
        ("a.csv", "Ana,one\n", r"a\.csv, line 1: 'one' is not a domain of Ana"),
        ("a.csv", "Ana,1\nBjörn,999\n", r"line 2: '999' is not a domain of Björn: .* 0 to 232"),
        ("a.csv", ",1\n", "line 1: the name is missing"),
        ("a.csv", "Ana,1\nBjörn,1\n", "line 2: domain 1 belongs to Ana and Björn"),
        ("a.csv", "\n", "holds no students"),
        ("a.yaml", "Ana: 1\nBjörn: [2]\n", r"a\.yaml, line 2: write a line"),
        ("a.yaml", "- Ana\n", r"a\.yaml, line 1: write a line"),
        ("a.yaml", "Ana: {", r"a\.yaml is not YAML"),
        ("a.yaml", "[" * 30_000, r"a\.yaml is nested too deeply"),
        ("a.csv", f"Ana,{'1' * 9_000}\n", r"line 1: '1{9000}' is not a domain of Ana"),
        ("a.csv", f'Ana,"{"x" * 200_000}"\n', r"a\.csv is not CSV: field larger"),
        ("a.csv", "\x1b[2J,x\n", r"not a domain of \\x1b\[2J"),
    ],
)
def test_a_wrong_roster(tmp_path, name, text, told):
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(ClassError, match=told):
        read_roster(tmp_path / name)


def test_a_roster_that_is_not_there(tmp_path):
    with pytest.raises(ClassError, match=r"the roster none\.csv cannot be read: .*No such file"):
        read_roster(tmp_path / "none.csv")
