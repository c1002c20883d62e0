"""What some tests need that a bare machine does not have; the texts say how to get it."""

COMPILED_CORE = "needs the compiled core (Debian: apt install g++ python3-dev; then scripts/setup)"
