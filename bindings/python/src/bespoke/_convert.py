"""What an option is in C, where 0 stands for the default and -1 for off."""

from __future__ import annotations

import operator

from ._native import BESPOKE_WEIGHT_OFF


def flag(name: str, value: bool | None) -> int:
    """True or False."""
    return 1 if value else 0


def member(name: str, value: int | None) -> int:
    """A member of an enum."""
    return count(name, value)


def count(name: str, value: int | None, bits: int = 32) -> int:
    """A whole number; 0 is the default, as in C."""
    if value is None:
        return 0
    whole = operator.index(value)
    if not 0 <= whole < 1 << bits:
        raise ValueError(f"option {name}: {whole} is not from 0 to 2^{bits} - 1")
    return whole


def count64(name: str, value: int | None) -> int:
    """A whole number of 64 bits."""
    return count(name, value, 64)


def length(name: str, value: float | None) -> float:
    """A number whose default is 0."""
    return 0.0 if value is None else float(value)


def positive(name: str, value: float | None) -> float:
    """A number that cannot be 0, which C would take for the default."""
    if value is not None and value == 0:
        raise ValueError(f"option {name} cannot be 0; leave it out, or give None, for the default")
    return 0.0 if value is None else float(value)


def weight(name: str, value: float | None) -> float:
    """A number that switches its term off where it is 0."""
    if value is None:
        return 0.0
    return BESPOKE_WEIGHT_OFF if value == 0 else float(value)
