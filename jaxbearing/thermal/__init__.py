"""Temperatures of a bearing's parts: network, losses by node, conductances, reference speed, warm-up."""
