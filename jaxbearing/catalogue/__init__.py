"""Standard bearings: from a designation, such as 6207 or NU 311, to boundary dimensions and an estimated internal geometry."""
