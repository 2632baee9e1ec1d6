#pragma once
#include <string>
#include <vector>

#include "insect/time_table.h"
#include "monarch_flight/insect/numeric_table.h"
#include "monarch_flight/insect/table_motion.h"

namespace monarch_flight {

/// Makes the signs of quaternions and the turns of angles continuous: q and -q, and angles a whole
/// turn apart, are the same attitude. An angle changes by at most pi from row to row.
void makeContinuous(NumericTable& table, TableKind kind);

/// Faults of a table with the columns of `kind` (TableMotion's constructor has them); quaternions
/// are normalised and everything is made continuous. `length` as there.
std::vector<std::string> checkTable(NumericTable& table, TableKind kind, double length);

/// Of checkTable, for a table that is good otherwise: changes from row to row that the changes
/// around them do not lead to (docs/case_files.md, motion).
std::vector<std::string> checkChanges(const NumericTable& table, TableKind kind, double length);

}  // namespace monarch_flight
