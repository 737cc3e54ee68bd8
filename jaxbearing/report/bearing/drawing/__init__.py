"""Drawings of a bearing: with its dimensions on paper, with its loads on a page."""
