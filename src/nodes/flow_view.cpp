#include "monarch_flight/ros_io/node_main.h"

int main(int argc, char** argv) { return monarch_flight::flowViewMain(argc, argv); }
