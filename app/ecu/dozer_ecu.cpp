#include "app/ecu/dozer_ecu.hpp"

#include "can_dbc/generated/dozer_dbc.hpp"

namespace graben::ecu {

bool DozerKind::is_command(std::uint32_t id) {
  return id == dbc::dozer::SpoolCommand::kId || id == dbc::dozer::PumpDisplacementCommand::kId ||
         id == dbc::dozer::MotorDisplacementCommand::kId;
}

template class EcuNode<DozerKind>;

}  // namespace graben::ecu
