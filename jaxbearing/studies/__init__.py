"""Studies: many solves of one bearing that answer a question, with labelled results and statements about them."""

from .claims import Claim, claims_of
from .power_loss import PowerLossStudy, power_loss_study

__all__ = ["Claim", "PowerLossStudy", "claims_of", "power_loss_study"]
