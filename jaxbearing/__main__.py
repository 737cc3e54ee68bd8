"""`python -m jaxbearing`: the same as the command `jaxbearing`."""

from jaxbearing.cli.main import main

if __name__ == "__main__":
    main()
