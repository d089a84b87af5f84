"""The example mini excavator: a JCB 8008 CTS with its swing boom and blade."""
