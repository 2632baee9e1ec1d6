"""Commands, figures and tests of monarch_flight in Python; the messages (monarch_flight.msg) stand beside them in a
build."""
from pkgutil import extend_path

__path__ = extend_path(__path__, __name__)  # messages and this source lie in different folders until they are installed
