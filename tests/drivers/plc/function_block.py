"""Runs the structured-text function block of configs/register-map.md as a controller would.

Usage: function_block.py client PORT   the block drives pymodbus as client; graspd is the server
       function_block.py server PORT   the block is the program of a PLC that is a pymodbus server; graspd polls it

Goes through the handshake ten times and prints the outcome of each. Ends with an assertion when an answer is
not as the page says. The worker behind graspd answers request 5 and 8 without a pick.
"""

import re
import sys
import threading
import time

PAGE = "configs/register-map.md"


class Timer:
    """The standard function block TON."""

    def __init__(self):
        self.since = None
        self.Q = False

    def __call__(self, IN, PT):
        if not IN:
            self.since = None
        elif self.since is None:
            self.since = time.monotonic()
        self.Q = self.since is not None and time.monotonic() - self.since >= PT


def translated(text):
    """The body of the block as Python: one statement a line, blocks by their END_ words."""
    body = text[text.rindex("END_VAR") + len("END_VAR") : text.index("END_FUNCTION_BLOCK")]
    body = re.sub(r"\(\*.*?\*\)", "", body, flags=re.S)
    body = re.sub(r"(?m)^(\d+):", r"LABEL \1;", body)
    body = re.sub(r"\b(THEN|OF|ELSE)\b", r"\1;", body)
    lines, depth = [], 1
    for statement in filter(None, (part.strip() for part in body.split(";"))):
        statement = re.sub(r"(?<![:<>])=", "==", statement).replace(":=", "=").replace("<>", "!=")
        for word, python in (("AND", "and"), ("OR", "or"), ("NOT", "not"), ("TRUE", "True"), ("FALSE", "False")):
            statement = re.sub(rf"\b{word}\b", python, statement)
        statement = re.sub(r"\bWORD_TO_UINT\((.*?)\)", r"\1", statement)
        if not statement.startswith("Watch("):
            statement = re.sub(r"(?<!\.)\b([A-Z][A-Za-z]*)\b(?=$|[^A-Za-z(])", lambda m: named(m.group(1)), statement)
        else:
            statement = re.sub(r"\b(?!Watch|IN|PT|True|False)([A-Z][A-Za-z]+)\b", r"v.\1", statement)
            statement = statement.replace("Watch(", "v.Watch(")
        if statement.startswith("LABEL"):
            lines.append("    if step == " + statement.split()[1] + ":")
            depth = 2
        elif statement.startswith("CASE"):
            lines.append("    step = v.Step")
        elif statement.startswith(("IF ", "ELSIF ")):
            depth -= statement.startswith("ELSIF")
            condition = re.sub(r"^(IF|ELSIF) (.*) THEN$", r"\2", statement)
            lines.append("    " * depth + ("elif " if statement.startswith("ELSIF") else "if ") + condition + ":")
            depth += 1
        elif statement == "END_IF":
            depth -= 1
        elif statement != "END_CASE":
            lines.append("    " * depth + statement)
    return "def program(v):\n" + "\n".join(lines) + "\n"


def named(word):
    return word if word in ("IF", "ELSIF", "THEN", "CASE", "OF", "END", "LABEL", "True", "False") else "v." + word


class Variables:
    def __init__(self, text):
        for names, kind in re.findall(r"(?m)^ +([A-Z][\w, ]*?) *: (\w+)", text[: text.rindex("END_VAR")]):
            for name in names.split(","):
                setattr(self, name.strip(), Timer() if kind == "TON" else 0 if kind in ("INT", "UINT") else False)
        self.Timeout = 5.0
        self.Block = [0] * 121


class ServerSide:
    """What the block sees of graspd when graspd is the server."""

    def __init__(self, port):
        from pymodbus.client import ModbusTcpClient

        self.client = ModbusTcpClient("127.0.0.1", port=port)
        assert self.client.connect()

    def request(self, request_id):
        assert not self.client.write_registers(0, [request_id, 3, 0, 0]).isError()

    def inputs(self):
        return self.client.read_discrete_inputs(0, 9).bits[:9]

    def block(self):
        return self.client.read_input_registers(0, 121).registers

    def coils(self, levels):
        assert not self.client.write_coils(0, levels).isError()

    def close(self):
        self.client.close()


class ClientSide:
    """The same when the PLC is the server: its own memory, which graspd reads and writes."""

    def __init__(self, port):
        from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
        from pymodbus.server import StartTcpServer

        self.memory = ModbusSlaveContext(
            co=ModbusSequentialDataBlock(0, [0] * 16),
            hr=ModbusSequentialDataBlock(0, [0] * 1700),
            zero_mode=True,
        )
        context = ModbusServerContext(slaves=self.memory, single=True)
        threading.Thread(
            target=StartTcpServer, kwargs={"context": context, "address": ("127.0.0.1", port)}, daemon=True
        ).start()

    def request(self, request_id):
        self.memory.setValues(16, 0, [request_id, 3, 0, 0])

    def inputs(self):
        status = self.memory.getValues(3, 1202, 1)[0]
        return [bool(status >> bit & 1) for bit in range(9)]

    def block(self):
        return self.memory.getValues(3, 1000, 121)

    def coils(self, levels):
        self.memory.setValues(15, 0, [int(level) for level in levels])

    def close(self):
        pass


def main():
    with open(PAGE, encoding="utf-8") as page:
        text = re.search(r"```iecst\n(.*?)```", page.read(), re.S).group(1)
    scope = {}
    exec(translated(text), scope)  # The page is part of this repository.
    v = Variables(text)
    side = ServerSide(int(sys.argv[2])) if sys.argv[1] == "client" else ClientSide(int(sys.argv[2]))
    found = 0
    for request_id in range(1, 11):
        v.RequestId = request_id
        side.request(request_id)
        v.Execute = True
        end = time.monotonic() + 30
        while not v.Finished:
            assert time.monotonic() < end, f"step {v.Step}"
            bits = side.inputs()
            v.Ready, v.Busy, v.Done, v.ResultValid = bits[0], bits[1], bits[3], bits[5]
            scope["program"](v)
            v.BlockIsRead = False
            if v.BlockRead:
                v.Block = side.block()
                v.BlockIsRead = True
            side.coils([v.Trigger, v.Acknowledge, v.Reset, v.Next])
            time.sleep(0.002)
        print(request_id, "found" if v.Found else "none", "failed" if v.Failed else "", v.Code)
        assert not v.Failed
        assert v.Found == (request_id not in (5, 8)) and v.Code == (0 if v.Found else 20)
        assert v.Block[2] == request_id
        found += v.Found
        v.Execute = False
        scope["program"](v)
        time.sleep(0.03)
    assert found == 8
    side.close()


main()
