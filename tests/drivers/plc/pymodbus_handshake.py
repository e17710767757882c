"""Goes through the handshake twenty times as a PLC would, with a Modbus library that is not ours.

Usage: pymodbus_handshake.py PORT. Ends with an assertion when an answer is not as the register map says.
"""

import struct
import sys
import time

from pymodbus.client import ModbusTcpClient

TRIGGER, ACKNOWLEDGE = 0, 1
DONE, ERROR, RESULT_VALID = 3, 4, 5


def float_at(registers, offset):
    return struct.unpack(">f", struct.pack(">HH", *registers[offset : offset + 2]))[0]


def main():
    client = ModbusTcpClient("127.0.0.1", port=int(sys.argv[1]))
    assert client.connect()
    for request_id in range(1000, 1020):
        assert not client.write_registers(0, [request_id, 3, 0, 0]).isError()
        assert not client.write_coil(TRIGGER, True).isError()
        end = time.monotonic() + 5
        while not client.read_discrete_inputs(DONE, 1).bits[0]:
            assert time.monotonic() < end, "no answer"
        inputs = client.read_discrete_inputs(0, 9).bits
        assert inputs[RESULT_VALID] and not inputs[ERROR]
        block = client.read_input_registers(0, 121).registers
        assert block[1] == block[120] and block[2] == request_id and block[3] == 0 and block[6] == 3
        assert abs(float_at(block, 26) - 123.456) < 1e-4
        assert abs(float_at(block, 34) - block[1]) < 1e-3, "x of the pick is the sequence, in millimetres"
        assert client.read_holding_registers(1000, 121).registers == block
        assert not client.write_coils(TRIGGER, [False, True]).isError()
        assert not client.write_coils(TRIGGER, [False, False]).isError()
        assert not client.read_discrete_inputs(DONE, 1).bits[0]
    assert client.write_register(1000, 1).isError(), "the block must not be writable"
    assert client.read_input_registers(0, 122).isError()
    client.close()


main()
