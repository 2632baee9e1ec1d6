"""What the other wing and the body would change: an estimate in potential flow (docs/verification.md)."""
