"""Pictures from recorded runs."""
