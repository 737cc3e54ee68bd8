"""The table [oil] and oil files: schema, catalogue, writer."""
