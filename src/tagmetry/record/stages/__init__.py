"""Pictures of what the detector sees at each step, with captions, and a page that shows them."""

from tagmetry.record.stages.write import write_stages

__all__ = ["write_stages"]
