"""The field solver of one lubricated line contact: pressure and film, steady and in time."""

from .history import LineContactHistory as LineContactHistory
from .last_state import FilmState as FilmState
from .line_contact import ContactBodies as ContactBodies
from .line_contact import ContactGeometry as ContactGeometry
from .line_contact import ContactOperation as ContactOperation
from .line_contact import EHLLineContact as EHLLineContact
from .line_contact import FilmModel as FilmModel
from .run import check_restart as check_restart
from .run import simulate_film as simulate_film
from .simulation import FilmSimulation as FilmSimulation
from .solution import LineContactSolution as LineContactSolution
from .solution import solve_line_contact as solve_line_contact
