#include "app/ecu/excavator_ecu.hpp"

#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::ecu {

bool ExcavatorKind::is_command(std::uint32_t id) {
  return id == dbc::excavator::SpoolCommand::kId || id == dbc::excavator::SwingCommand::kId;
}

template class EcuNode<ExcavatorKind>;

}  // namespace graben::ecu
