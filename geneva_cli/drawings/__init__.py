"""What is shown of the parts: list, drawings, sheets, milling paths."""
