"""``python -m fiveroute`` is the command line."""

from fiveroute.cli import main

if __name__ == "__main__":
    main()
