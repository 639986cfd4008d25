"""``geneva schema``."""


def run(output: str = "-") -> None:
    """Print a JSON Schema (draft-07) of specs, with which editors complete and check keys.

    Examples:
      geneva schema -o geneva.schema.json
    """
    import json

    from geneva_cli.output import show_text
    from geneva_cli.specfile.keys import schema

    show_text(json.dumps(schema(), indent=1, ensure_ascii=False) + "\n", output)
