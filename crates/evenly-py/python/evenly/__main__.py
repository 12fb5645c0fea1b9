"""``python -m evenly``: the command line."""

from evenly._command import main

if __name__ == "__main__":
    main()
