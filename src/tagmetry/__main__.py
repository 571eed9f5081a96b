"""`python -m tagmetry`: the command, where its own name is not on the path."""

from tagmetry.cli.main import main

if __name__ == "__main__":
    main()
