"""The measured flight."""
